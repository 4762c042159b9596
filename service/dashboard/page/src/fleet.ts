// The fleet: ten thousand rows of which only those in sight are in the page.

import { find, make, mark, say } from "./dom";
import { fixed, small } from "./format";
import { UNRESOLVED } from "./frame";

interface Columns {
  spacecraft: number;
  name: string[];
  service: string[];
  time_s: (number | null)[];
  rate_rad_s: (number | null)[];
  momentum_n_m_s: (number | null)[];
  energy_j: (number | null)[];
  energy_residual_j: (number | null)[];
  flags: number[];
}

type Key = Exclude<keyof Columns, "spacecraft">;

const kHeads: { key: Key; head: string; class: string; text(columns: Columns, i: number): string }[] = [
  { key: "name", head: "name", class: "name", text: (c, i) => c.name[i]! },
  { key: "service", head: "service", class: "wide", text: (c, i) => c.service[i]! },
  { key: "time_s", head: "t [s]", class: "wide number", text: (c, i) => fixed(c.time_s[i], 1) },
  { key: "rate_rad_s", head: "|ω| [rad/s]", class: "number", text: (c, i) => fixed(c.rate_rad_s[i], 4) },
  { key: "momentum_n_m_s", head: "|H| [N m s]", class: "number", text: (c, i) => fixed(c.momentum_n_m_s[i], 4) },
  { key: "energy_residual_j", head: "ΔE [J]", class: "wide number", text: (c, i) => small(c.energy_residual_j[i]) },
  { key: "flags", head: "state", class: "state", text: (c, i) => (c.flags[i]! & UNRESOLVED ? "✕ unresolved" : "✓ resolved") },
]; // prettier-ignore

const kRow_px = 28;
const kPoll_ms = 2000;
const kMargin = 6;
const kMostRows = 11;

export class Fleet {
  private columns: Columns | undefined;
  private order: number[] = [];
  private sortBy: Key = "name";
  private descending = false;
  private cursor = 0;
  private watched = "";
  private inSight = false;

  private readonly grid = make("div", { class: "grid-table", role: "grid", tabindex: "0", "aria-label": "Fleet" });
  private readonly head = make("div", { class: "grid-head", role: "row" });
  private readonly viewport = make("div", { class: "viewport", role: "rowgroup" });
  private readonly sheet = make("div", { class: "sheet", role: "presentation" });
  private readonly rows: HTMLElement[] = [];
  private readonly filter = find<HTMLInputElement>("#fleet-filter");
  private readonly onlyUnresolved = find<HTMLInputElement>("#fleet-unresolved");
  private readonly count = find<HTMLElement>("#fleet-count");

  constructor(
    place: HTMLElement,
    private readonly onPick: (name: string) => void,
  ) {
    for (const { key, head, class: kind } of kHeads) {
      const button = make("button", { type: "button", text: head });
      button.addEventListener("click", () => this.sort(key));
      this.head.append(make("div", { role: "columnheader", class: kind, "data-key": key }, button));
    }
    this.viewport.append(this.sheet);
    this.grid.append(this.viewport);
    place.append(this.head, this.grid);
    this.viewport.addEventListener("scroll", () => this.draw(), { passive: true });
    new ResizeObserver(() => this.draw()).observe(this.viewport);
    this.filter.addEventListener("input", () => this.arrange());
    this.onlyUnresolved.addEventListener("change", () => this.arrange());
    this.grid.addEventListener("keydown", (event) => this.onKey(event));
    this.sheet.addEventListener("click", (event) => {
      const row = (event.target as Element).closest<HTMLElement>("[data-at]");
      if (row !== null) {
        this.cursor = Number(row.dataset.at);
        this.pick();
      }
    });
    new IntersectionObserver((entries) => {
      this.inSight = entries.at(-1)!.isIntersecting;
    }).observe(place);
    this.showSort();
    void this.poll(true);
  }

  setWatched(name: string): void {
    if (name !== this.watched) {
      this.watched = name;
      this.draw();
    }
  }

  private async poll(always = false): Promise<void> {
    try {
      if ((this.inSight || always) && !document.hidden) {
        const response = await fetch("/fleet");
        if (response.ok) {
          this.columns = (await response.json()) as Columns;
          this.arrange();
        }
      }
    } catch {
      // The status strip says that the server is lost.
    }
    window.setTimeout(() => void this.poll(this.columns === undefined || this.columns.spacecraft === 0), kPoll_ms);
  }

  private sort(key: Key): void {
    this.descending = key === this.sortBy ? !this.descending : key !== "name" && key !== "service";
    this.sortBy = key;
    this.showSort();
    this.arrange();
  }

  private showSort(): void {
    for (const head of this.head.children) {
      const ours = head.getAttribute("data-key") === this.sortBy;
      mark(head, "aria-sort", !ours ? "none" : this.descending ? "descending" : "ascending");
    }
  }

  private arrange(): void {
    const columns = this.columns;
    if (columns === undefined) {
      return;
    }
    const current = this.nameAt(this.cursor);
    const wanted = this.filter.value.trim().toLowerCase();
    const all = [...columns.name.keys()];
    this.order = all.filter(
      (i) =>
        (wanted === "" || columns.name[i]!.toLowerCase().includes(wanted)) &&
        (!this.onlyUnresolved.checked || (columns.flags[i]! & UNRESOLVED) !== 0),
    );
    const values = columns[this.sortBy];
    const sign = this.descending ? -1 : 1;
    if (this.sortBy === "name" || this.sortBy === "service") {
      const { compare } = new Intl.Collator("en", { numeric: true });
      this.order.sort((a, b) => sign * compare(values[a] as string, values[b] as string) || a - b);
    } else {
      const number = (i: number) => (values[i] as number | null) ?? -Infinity;
      this.order.sort((a, b) => sign * (number(a) - number(b)) || a - b);
    }
    const kept = current === undefined ? -1 : this.order.findIndex((i) => columns.name[i] === current);
    this.cursor = Math.max(0, kept === -1 ? Math.min(this.cursor, this.order.length - 1) : kept);
    const of = columns.name.length === this.order.length ? "" : ` of ${columns.name.length.toLocaleString("en")}`;
    const cut = columns.spacecraft > columns.name.length ? `, the first of ${columns.spacecraft.toLocaleString("en")}` : "";
    say(this.count, `${this.order.length.toLocaleString("en")}${of} spacecraft${cut}`);
    mark(this.grid, "aria-rowcount", String(this.order.length));
    this.sheet.style.height = `${this.order.length * kRow_px}px`;
    this.viewport.style.height = `${Math.min(kMostRows, Math.max(3, this.order.length)) * kRow_px}px`;
    this.draw();
  }

  private draw(): void {
    const columns = this.columns;
    if (columns === undefined) {
      return;
    }
    const first = Math.max(0, Math.floor(this.viewport.scrollTop / kRow_px) - kMargin);
    const most = Math.ceil(this.viewport.clientHeight / kRow_px) + 2 * kMargin;
    const shown = Math.max(0, Math.min(most, this.order.length - first));
    while (this.rows.length < shown) {
      const row = make("div", { role: "row", class: "grid-row" },
        ...kHeads.map((head) => make("div", { role: "gridcell", class: head.class }))); // prettier-ignore
      this.rows.push(row);
      this.sheet.append(row);
    }
    while (this.rows.length > shown) {
      this.rows.pop()!.remove();
    }
    this.rows.forEach((row, k) => {
      const at = first + k;
      const i = this.order[at]!;
      row.dataset.at = String(at);
      row.id = `fleet-row-${at}`;
      row.style.transform = `translateY(${at * kRow_px}px)`;
      mark(row, "aria-rowindex", String(at + 1));
      mark(row, "aria-selected", String(columns.name[i] === this.watched));
      row.classList.toggle("cursor", at === this.cursor);
      row.classList.toggle("unresolved", (columns.flags[i]! & UNRESOLVED) !== 0);
      kHeads.forEach((head, c) => say(row.children[c]!, head.text(columns, i)));
    });
    mark(this.grid, "aria-activedescendant", this.order.length === 0 ? "" : `fleet-row-${this.cursor}`);
  }

  private onKey(event: KeyboardEvent): void {
    const page = Math.max(1, Math.floor(this.viewport.clientHeight / kRow_px) - 1);
    const moves: Record<string, number> = {
      ArrowDown: 1, ArrowUp: -1, PageDown: page, PageUp: -page, Home: -Infinity, End: Infinity,
    }; // prettier-ignore
    const move = moves[event.key];
    if (move !== undefined) {
      this.cursor = Math.max(0, Math.min(this.order.length - 1, this.cursor + move));
      const top = this.cursor * kRow_px;
      const bottom = top + kRow_px - this.viewport.clientHeight;
      this.viewport.scrollTop = Math.max(bottom, Math.min(top, this.viewport.scrollTop));
      this.draw();
    } else if (event.key === "Enter" || event.key === " ") {
      this.pick();
    } else {
      return;
    }
    event.preventDefault();
  }

  private pick(): void {
    const name = this.nameAt(this.cursor);
    if (name !== undefined) {
      this.onPick(name);
      this.draw();
    }
  }

  private nameAt(at: number): string | undefined {
    const i = this.order[at];
    return i === undefined ? undefined : this.columns?.name[i];
  }
}
