// An hour of one spacecraft at ten samples a second, in memory of fixed size.

import { length, type Motion } from "./frame";

export const kColumns = [
  "t", "H_I_x", "H_I_y", "H_I_z", "Pi_B_x", "Pi_B_y", "Pi_B_z",
  "omega_x", "omega_y", "omega_z", "energy_residual", "momentum_residual",
] as const; // prettier-ignore
export type ColumnName = (typeof kColumns)[number];

const kCapacity = 36_600;

export class History {
  private readonly columns = new Map<ColumnName, Float64Array>(
    kColumns.map((name) => [name, new Float64Array(kCapacity)]),
  );
  private first = 0;
  private run = "";
  size = 0;

  /// Begins anew when the spacecraft or the run is another.
  add(motion: Motion, run: string): void {
    const key = `${motion.name}\n${run}`;
    if (key !== this.run || motion.time_s < this.latest()) {
      this.run = key;
      this.first = this.size = 0;
    }
    if (this.size > 0 && motion.time_s === this.latest()) {
      return;
    }
    const at = (this.first + this.size) % kCapacity;
    const put = (name: ColumnName, value: number | null) => {
      this.columns.get(name)![at] = value ?? NaN;
    };
    put("t", motion.time_s);
    (["x", "y", "z"] as const).forEach((axis, i) => {
      put(`H_I_${axis}`, motion.H_I_n_m_s[i]!);
      put(`Pi_B_${axis}`, motion.Pi_B_n_m_s[i]!);
      put(`omega_${axis}`, motion.omega_B_rad_s[i]!);
    });
    put("energy_residual", motion.energy_residual_j);
    put("momentum_residual", length(motion.momentum_residual_I_n_m_s));
    if (this.size < kCapacity) {
      ++this.size;
    } else {
      this.first = (this.first + 1) % kCapacity;
    }
  }

  earliest(): number {
    return this.size === 0 ? Infinity : this.at(this.columns.get("t")!, 0);
  }

  latest(): number {
    return this.size === 0 ? -Infinity : this.at(this.columns.get("t")!, this.size - 1);
  }

  /// The last `window_s` seconds as at most 2 `buckets` points a column, least and greatest of each
  /// bucket, so that no peak is lost.
  decimated(names: readonly ColumnName[], window_s: number, buckets: number): (number | null)[][] {
    const t = this.columns.get("t")!;
    const from = this.firstAfter(this.latest() - window_s);
    const count = this.size - from;
    const width = Math.max(1, Math.ceil(count / buckets));
    const sources = names.map((name) => this.columns.get(name)!);
    const result: (number | null)[][] = [[], ...names.map(() => [])];
    for (let begin = from; begin < this.size; begin += width) {
      const end = Math.min(begin + width, this.size);
      const single = end - begin === 1;
      result[0]!.push(this.at(t, begin));
      if (!single) {
        result[0]!.push(this.at(t, end - 1));
      }
      sources.forEach((source, s) => {
        let least = Infinity, greatest = -Infinity, leastAt = begin, greatestAt = begin; // prettier-ignore
        for (let i = begin; i < end; ++i) {
          const value = this.at(source, i);
          if (value < least) {
            least = value;
            leastAt = i;
          }
          if (value > greatest) {
            greatest = value;
            greatestAt = i;
          }
        }
        const [a, b] = leastAt <= greatestAt ? [least, greatest] : [greatest, least];
        const column = result[s + 1]!;
        column.push(Number.isFinite(a) ? a : null);
        if (!single) {
          column.push(Number.isFinite(b) ? b : null);
        }
      });
    }
    return result;
  }

  private at(column: Float64Array, i: number): number {
    return column[(this.first + i) % kCapacity]!;
  }

  private firstAfter(time_s: number): number {
    const t = this.columns.get("t")!;
    let low = 0, high = this.size; // prettier-ignore
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.at(t, middle) < time_s) {
        low = middle + 1;
      } else {
        high = middle;
      }
    }
    return low;
  }
}
