// The spacecraft in three dimensions: the inertial frame stands still, the body turns in it, H_I
// stands where momentum is conserved, omega moves.

import {
  ArrowHelper,
  BoxGeometry,
  CanvasTexture,
  Color,
  EdgesGeometry,
  GridHelper,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  PerspectiveCamera,
  Quaternion,
  Scene as ThreeScene,
  SRGBColorSpace,
  Sprite,
  SpriteMaterial,
  Vector3,
  WebGLRenderer,
} from "three";

import { make } from "./dom";
import type { Motion, Triple } from "./frame";
import { colour, onThemeChange } from "./theme";
import { Thrift } from "./thrift";

const kArrow = { axis: 1.5, momentum: 2.2, rate: 1.8, inertial: 2.3 };
/// Longer than this without news nothing is extrapolated.
const kLongest_s = 0.5;

function vector(v: Triple): Vector3 | undefined {
  return v.some((c) => c === null) ? undefined : new Vector3(v[0]!, v[1]!, v[2]!);
}

export class Scene {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new ThreeScene();
  private readonly camera = new PerspectiveCamera(38, 1, 0.1, 60);
  private readonly body = new Group();
  private momentum = new Group();
  private rate = new Group();
  private azimuth = 0.7;
  private elevation = 0.42;
  private distance = 7.8;

  private readonly q_IB = new Quaternion(); // as heard
  private readonly shown = new Quaternion(); // as drawn
  private omega_B = new Vector3();
  private heard_ms = -Infinity;
  private time_s = NaN;
  private pace = 0; // simulated seconds per second, as seen
  private dirty = true;
  private visible = true;
  private readonly thrift = new Thrift();
  private readonly calm = matchMedia("(prefers-reduced-motion: reduce)");
  drawn = 0;

  constructor(private readonly place: HTMLElement) {
    this.renderer = new WebGLRenderer({ antialias: true, alpha: true });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    place.append(this.renderer.domElement);
    this.camera.up.set(0, 0, 1);
    this.paint();
    onThemeChange(() => this.paint());
    new ResizeObserver(() => this.fit()).observe(place);
    new IntersectionObserver((entries) => {
      this.visible = entries.at(-1)!.isIntersecting;
    }).observe(place);
    this.listen();
    const frame = (now_ms: number) => {
      requestAnimationFrame(frame);
      if (this.thrift.admits(now_ms)) {
        this.draw();
      }
    };
    requestAnimationFrame(frame);
    document.addEventListener("visibilitychange", () => this.thrift.wake());
  }

  show(motion: Motion): void {
    const [w, x, y, z] = motion.q_IB;
    if (w === null || x === null || y === null || z === null || motion.time_s === this.time_s) {
      return;
    }
    const now = performance.now();
    const elapsed_s = (now - this.heard_ms) / 1000;
    const pace = (motion.time_s - this.time_s) / elapsed_s;
    this.pace = Number.isFinite(pace) && pace > 0 && elapsed_s < 2 ? 0.8 * this.pace + 0.2 * pace : 0;
    const fresh = !(elapsed_s < 2);
    this.heard_ms = now;
    this.time_s = motion.time_s;
    this.q_IB.set(x, y, z, w);
    if (fresh) {
      this.shown.copy(this.q_IB);
    }
    this.omega_B = vector(motion.omega_B_rad_s) ?? new Vector3();
    this.point(this.momentum, vector(motion.H_I_n_m_s));
    this.dirty = true;
  }

  /// Whether it is known how often the view may be drawn, for the page's own tests.
  get settled(): boolean {
    return this.thrift.settled;
  }

  /// The attitude that is drawn now, for the page's own tests: w first.
  attitude(): number[] {
    return [this.shown.w, this.shown.x, this.shown.y, this.shown.z];
  }

  private draw(): void {
    const silent_s = (performance.now() - this.heard_ms) / 1000;
    const moving = silent_s < kLongest_s && !this.calm.matches && this.omega_B.lengthSq() > 0;
    if (!this.visible || (!moving && !this.dirty)) {
      return;
    }
    this.dirty = false;
    const predicted = this.q_IB.clone();
    if (moving) {
      // q(t) = q exp(omega_B t / 2)
      const angle = this.omega_B.length() * silent_s * this.pace;
      predicted.multiply(
        new Quaternion().setFromAxisAngle(this.omega_B.clone().normalize(), angle),
      );
    }
    this.shown.slerp(predicted, moving ? 1 - 0.75 ** this.thrift.every : 1).normalize();
    this.body.quaternion.copy(this.shown);
    this.point(this.rate, this.omega_B.clone().applyQuaternion(this.shown));
    this.camera.position.set(
      this.distance * Math.cos(this.elevation) * Math.cos(this.azimuth),
      this.distance * Math.cos(this.elevation) * Math.sin(this.azimuth),
      this.distance * Math.sin(this.elevation),
    );
    this.camera.lookAt(0, 0, 0.25);
    this.renderer.render(this.scene, this.camera);
    ++this.drawn;
    this.thrift.drew();
  }

  private point(arrow: Group, direction: Vector3 | undefined): void {
    arrow.visible = direction !== undefined && direction.lengthSq() > 0;
    if (direction !== undefined && arrow.visible) {
      arrow.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), direction.clone().normalize());
    }
  }

  private fit(): void {
    const { clientWidth: width, clientHeight: height } = this.place;
    if (width > 0 && height > 0) {
      this.renderer.setSize(width, height);
      this.camera.aspect = width / height;
      this.camera.updateProjectionMatrix();
      this.thrift.reset();
      this.dirty = true;
    }
  }

  /// Everything anew, in the colours of the theme.
  private paint(): void {
    this.scene.traverse((object) => {
      if (object instanceof Mesh || object instanceof LineSegments || object instanceof Sprite) {
        object.geometry.dispose();
        const materials = [object.material].flat();
        materials.forEach((material) => {
          (material as SpriteMaterial).map?.dispose();
          material.dispose();
        });
      }
    });
    this.scene.clear();
    this.body.clear();
    const grid = new GridHelper(5, 10, new Color(colour("grid")), new Color(colour("grid")));
    grid.rotation.x = Math.PI / 2;
    this.scene.add(grid);
    const units = { x: new Vector3(1, 0, 0), y: new Vector3(0, 1, 0), z: new Vector3(0, 0, 1) };
    for (const [axis, unit] of Object.entries(units)) {
      this.scene.add(arrow(unit, kArrow.inertial, colour("faint"), `${axis}_I`, 0.012));
      this.body.add(arrow(unit, kArrow.axis, colour(axis), `${axis}_B`, 0.03));
    }
    const shape = new BoxGeometry(1.5, 1.0, 0.7);
    this.body.add(
      new Mesh(
        shape,
        new MeshBasicMaterial({ color: colour("body"), transparent: true, opacity: 0.55 }),
      ),
      new LineSegments(new EdgesGeometry(shape), new LineBasicMaterial({ color: colour("ink") })),
    );
    const forward = new Vector3(0, 0, 1);
    this.momentum = arrow(forward, kArrow.momentum, colour("momentum"), "H_I", 0.05);
    this.rate = arrow(forward, kArrow.rate, colour("rate"), "ω", 0.05);
    this.momentum.visible = this.rate.visible = false;
    this.scene.add(this.body, this.momentum, this.rate);
    this.time_s = NaN; // the next frame points the arrows
    this.dirty = true;
  }

  private listen(): void {
    const turn = (azimuth: number, elevation: number) => {
      this.azimuth += azimuth;
      this.elevation = Math.max(-1.5, Math.min(1.5, this.elevation + elevation));
      this.dirty = true;
    };
    const zoom = (factor: number) => {
      this.distance = Math.max(3, Math.min(20, this.distance * factor));
      this.dirty = true;
    };
    const keys: Record<string, () => void> = {
      ArrowLeft: () => turn(-0.1, 0),
      ArrowRight: () => turn(0.1, 0),
      ArrowUp: () => turn(0, 0.1),
      ArrowDown: () => turn(0, -0.1),
      "+": () => zoom(0.9),
      "=": () => zoom(0.9),
      "-": () => zoom(1.1),
    };
    this.place.addEventListener("keydown", (event) => {
      const action = keys[event.key];
      if (action !== undefined && !event.ctrlKey && !event.metaKey && !event.altKey) {
        action();
        event.preventDefault();
      }
    });
    this.place.addEventListener("pointerdown", (event) => {
      this.place.setPointerCapture(event.pointerId);
    });
    this.place.addEventListener("pointermove", (event) => {
      if (event.buttons === 1) {
        turn(-event.movementX * 0.008, event.movementY * 0.008);
      }
    });
  }
}

/// An arrow along `direction` from the origin, with its name at the tip.
function arrow(direction: Vector3, size: number, paint: string, name: string, thickness: number): Group {
  const group = new Group();
  const helper = new ArrowHelper(direction, new Vector3(), size, paint, 0.2, 0.12);
  const shaft = new Mesh(
    new BoxGeometry(thickness, thickness, size - 0.15),
    new MeshBasicMaterial({ color: paint }),
  );
  shaft.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), direction);
  shaft.position.copy(direction).multiplyScalar((size - 0.15) / 2);
  const label = sprite(name, paint);
  label.position.copy(direction).multiplyScalar(size + 0.2);
  group.add(helper, shaft, label);
  return group;
}

function sprite(text: string, paint: string): Sprite {
  const canvas = make("canvas", { width: "128", height: "64" });
  const context = canvas.getContext("2d")!;
  context.font = "bold 40px system-ui, sans-serif";
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.fillStyle = paint;
  context.fillText(text, 64, 32);
  const map = new CanvasTexture(canvas);
  map.colorSpace = SRGBColorSpace;
  const label = new Sprite(new SpriteMaterial({ map, depthTest: false, transparent: true }));
  label.scale.set(0.72, 0.36, 1);
  label.renderOrder = 1;
  return label;
}

/// In words where there is no WebGL.
export function sceneIn(place: HTMLElement): Scene | undefined {
  try {
    return new Scene(place);
  } catch {
    place.append(make("p", { class: "quiet", text: "This browser gives no WebGL: no view in three dimensions. The numbers below are the same." })); // prettier-ignore
    return undefined;
  }
}
