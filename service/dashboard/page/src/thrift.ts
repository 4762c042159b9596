// How often the view may be drawn so that the page keeps its own frames: without a graphics processor one picture takes longer than a
// frame, and everything else on the page would wait for it.

/// A page that keeps its frames has them 60 times a second.
const kFrame_ms = 18;
const kFewest = 5;
const kJudged = 60; // frames

export class Thrift {
  /// Of so many animation frames one is drawn.
  every = 1;
  private passed = 0;
  private drawn = 0;
  private last_ms = NaN;
  private gaps: number[] = [];
  private before_ms = Infinity; // a frame's length, drawn one time more
  private settled = false;

  /// The view has another size: begins again.
  reset(): void {
    this.every = 1;
    this.before_ms = Infinity;
    this.settled = false;
    this.gaps = [];
    this.drawn = 0;
  }

  /// Asked once in each animation frame: whether to draw in this one.
  admits(now_ms: number): boolean {
    const gap_ms = now_ms - this.last_ms;
    this.last_ms = now_ms;
    if (gap_ms < 250) {
      this.gaps.push(gap_ms); // a page that nobody sees has none
    }
    if (this.gaps.length === kJudged) {
      this.judge();
    }
    this.passed = (this.passed + 1) % this.every;
    return this.passed === 0;
  }

  drew(): void {
    ++this.drawn;
  }

  private judge(): void {
    const mean_ms = this.gaps.reduce((sum, gap) => sum + gap, 0) / kJudged;
    const busy = this.drawn > kJudged / this.every / 2;
    this.gaps = [];
    this.drawn = 0;
    if (this.settled || !busy) {
      return;
    }
    if (mean_ms <= kFrame_ms) {
      this.settled = true;
    } else if (mean_ms < 0.95 * this.before_ms && this.every < kFewest) {
      this.before_ms = mean_ms;
      ++this.every;
    } else {
      this.every = Math.max(1, this.every - 1); // it is not the view that the page waits for
      this.settled = true;
    }
  }
}
