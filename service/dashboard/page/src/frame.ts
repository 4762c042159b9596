// What the server says: see service/dashboard/server/frame_json.hpp. null: not known.

export type Number = number | null;
export type Triple = [Number, Number, Number];

export interface Motion {
  name: string;
  service: string;
  step: number;
  time_s: number;
  age_s: number;
  q_IB: [Number, Number, Number, Number]; // w first, body to inertial
  omega_B_rad_s: Triple;
  H_I_n_m_s: Triple;
  Pi_B_n_m_s: Triple;
  momentum_residual_I_n_m_s: Triple;
  energy_j: Number;
  work_j: Number;
  energy_residual_j: Number;
  flags: number;
}

export interface Quantiles {
  count: number;
  p50_ns: number;
  p99_ns: number;
  p99_9_ns: number;
  max_ns: number;
}

export interface Phase extends Quantiles {
  quarter_octaves: number[]; // beats below 256 ns, then [256, 304), ...; the last: 2^30 ns or more (idl/health.idl)
  budget_ns: number;
  over_budget: number;
}

export interface Timing {
  step: number;
  time_ns: number;
  wake_up_lateness: Phase;
  command_phase: Phase;
  step_phase: Phase;
  hand_over_phase: Phase;
  late_beats: number;
  late_after_work: number;
  late_after_loss: number;
  late_after_sleep: number;
  missed_beats: number;
  caught_up_beats: number;
  overruns: number;
  behind_wall_ns: number;
  fifo_scheduling: boolean;
  memory_locked: boolean;
  cpu_pinned: boolean;
}

export interface Service {
  name: string;
  age_s: number;
  state: string;
  run?: string;
  step?: number;
  time_s?: number;
  step_length_ns?: number;
  pace?: string;
  scheme?: string;
  spacecraft?: number;
  unresolved_spacecraft?: number;
  worst_momentum_residual_relative?: Number;
  commands_received?: number;
  commands_refused?: number;
  commands_lost?: number;
  verdicts_lost?: number;
  telemetry_lost?: number;
  bridge_restarts?: number;
  timing?: Timing;
}

export interface Verdict {
  number: number;
  spacecraft: string;
  actuator: string;
  service: string;
  sequence: number;
  verdict: string;
  reason: string;
  time_s: number;
  start_s: number;
  end_s: number;
  torque_applied_n_m: Triple;
}

export interface Frame {
  watched: string;
  spacecraft: Motion | null;
  actuators: string[];
  services: Service[];
  verdicts: Verdict[];
}

export interface About {
  commands_allowed: boolean;
  place: string;
}

/// FLAG_UNRESOLVED_... of idl/telemetry.idl, and what goes with them.
export const UNRESOLVED = 1 | 2 | 8 | 64 | 128;

export function length(v: Triple): number {
  return v.some((c) => c === null) ? NaN : Math.hypot(v[0]!, v[1]!, v[2]!);
}
