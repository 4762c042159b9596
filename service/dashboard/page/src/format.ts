// Numbers as people read them.

/// Fixed width for a column that changes: sign, six digits.
export function fixed(value: number | null | undefined, digits = 6): string {
  if (value === null || value === undefined || !Number.isFinite(value)) {
    return "–";
  }
  const size = Math.abs(value);
  const text =
    size !== 0 && (size < 1e-3 || size >= 1e5) ? value.toExponential(3) : value.toFixed(digits);
  return text.replace("-", "−");
}

export function small(value: number | null | undefined): string {
  return value === null || value === undefined || !Number.isFinite(value)
    ? "–"
    : value === 0
      ? "0"
      : value.toExponential(1).replaceAll("-", "−");
}

/// Nanoseconds as microseconds.
export function microseconds(ns: number): string {
  const us = ns / 1000;
  return us >= 100 ? Math.round(us).toLocaleString("en") : us.toFixed(1);
}

export function counted(n: number | undefined): string {
  return n === undefined ? "–" : n.toLocaleString("en");
}

/// 3723.4: "1:02:03"
export function clock(seconds: number): string {
  const whole = Math.floor(seconds);
  const two = (n: number) => String(n).padStart(2, "0");
  return `${Math.floor(whole / 3600)}:${two(Math.floor(whole / 60) % 60)}:${two(whole % 60)}`;
}
