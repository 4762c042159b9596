// How often the view may be drawn so that the page keeps its own frames: without a graphics processor one picture takes longer than a
// frame, and everything else on the page would wait for it.
//
// While the page does not keep its frames, one more of them goes without a picture, as long as that helps. Once it keeps them, one
// less is tried again after a while: what was slow may have been the page's start, or another program.

/// A page that keeps its frames has them 60 times a second; one in thirty may be missed.
const kFrame_ms = 17.2;
const kDisplay_ms = 1000 / 60;
const kFewest = 5;
/// Judged together: so many frames, or what this time has of them.
const kFrames = 60;
const kWindow_ms = 2000;
/// Windows until it is tried again, and at most, where it was tried in vain.
const kSoon = 8;
const kLate = 128;

export class Thrift {
  /// Of so many animation frames one is drawn.
  every = 1;
  /// Whether the page keeps its frames so, or cannot for all that the view does.
  settled = false;
  private passed = 0;
  private last_ms = NaN;
  private frames = 0;
  private took_ms = 0;
  private drawn = 0;
  private before_ms = Infinity; // a frame, while one more of them was drawn
  private trying = false; // one less goes without
  private rest = 0; // windows in which nothing is tried
  private pause = kSoon;
  private settled_ms = NaN; // a frame, when it rested: where it is much shorter now, what was slow then is over

  /// The view has another size: begins again.
  reset(): void {
    Object.assign(this, new Thrift());
  }

  /// Nobody saw the page until now: it had no frames.
  wake(): void {
    this.last_ms = NaN;
  }

  /// Asked once in each animation frame: whether to draw in this one.
  admits(now_ms: number): boolean {
    if (!Number.isNaN(this.last_ms)) {
      ++this.frames;
      this.took_ms += now_ms - this.last_ms;
      if (this.frames >= kFrames || this.took_ms >= kWindow_ms) {
        this.judge(this.took_ms / this.frames, this.drawn > this.frames / this.every / 2);
        this.frames = this.took_ms = this.drawn = 0;
      }
    }
    this.last_ms = now_ms;
    this.passed = (this.passed + 1) % this.every;
    return this.passed === 0;
  }

  drew(): void {
    ++this.drawn;
  }

  private judge(frame_ms: number, busy: boolean): void {
    if (!busy) {
      return; // whatever it was, it was not the view
    }
    const slow = frame_ms > kFrame_ms;
    if (this.trying) {
      this.trying = false;
      this.every += slow ? 1 : 0;
      this.settle(slow, slow ? kDisplay_ms : frame_ms);
    } else if (this.rest > 0 && !(frame_ms < 0.7 * this.settled_ms)) {
      --this.rest;
    } else if (!slow) {
      this.before_ms = Infinity;
      this.trying = this.every > 1;
      this.every -= this.trying ? 1 : 0;
      this.settled = true;
    } else if (frame_ms - kDisplay_ms > 0.75 * (this.before_ms - kDisplay_ms)) {
      --this.every; // the last one did not help: it is not the view that the page waits for
      this.before_ms = Infinity;
      this.settle(true, frame_ms);
    } else if (this.every < kFewest) {
      ++this.every;
      this.before_ms = frame_ms;
      this.settled = false;
    } else {
      this.settle(true, frame_ms);
    }
  }

  private settle(in_vain: boolean, frame_ms: number): void {
    this.settled = true;
    this.settled_ms = frame_ms;
    this.pause = in_vain ? Math.min(2 * this.pause, kLate) : kSoon;
    this.rest = this.pause;
  }
}
