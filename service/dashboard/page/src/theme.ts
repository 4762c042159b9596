// Colours live in style.css; what is drawn on a canvas asks for them here. Axes differ by dash, too.

export type Axis = "x" | "y" | "z";

export function colour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

export const kDash: Record<Axis, number[]> = { x: [], y: [7, 4], z: [2, 3] };

export function onThemeChange(listener: () => void): void {
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", listener);
}
