// The server's events, however often the server goes and comes.

import type { Frame } from "./frame";

const kRetry_ms = 2000;

export class Stream {
  private source: EventSource | undefined;
  private retry: number | undefined;
  private watched = "";
  lastFrame_ms = -Infinity; // performance.now()

  constructor(
    private readonly onFrame: (frame: Frame) => void,
    /// A connection begins: verdicts come from the beginning again.
    private readonly onOpen: () => void,
  ) {}

  watch(spacecraft: string): void {
    this.watched = spacecraft;
    this.connect();
  }

  private connect(): void {
    window.clearTimeout(this.retry);
    this.source?.close();
    const query = this.watched === "" ? "" : `?spacecraft=${encodeURIComponent(this.watched)}`;
    const source = new EventSource(`/events${query}`);
    this.source = source;
    source.onopen = () => this.onOpen();
    source.onmessage = (event: MessageEvent<string>) => {
      this.lastFrame_ms = performance.now();
      this.onFrame(JSON.parse(event.data) as Frame);
    };
    // The browser gives up for good where an answer is no stream.
    source.onerror = () => {
      source.close();
      window.clearTimeout(this.retry);
      this.retry = window.setTimeout(() => this.connect(), kRetry_ms);
    };
  }
}
