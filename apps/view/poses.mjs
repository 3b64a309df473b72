// How the bodies are held: joints bent by hand, or a clip that is played.
import * as THREE from "three";

export class Poses {
  constructor(figures) {
    this.figures = figures.filter((figure) => figure.bones.length > 0);
    this.bends = new Map();
    this.tracks = []; // of the bodies that follow the clip
    this.clip = null;
    this.playing = false;
    this.time = 0;
  }

  /// The names of all clips that a body has.
  clips() {
    return [...new Set(this.figures.flatMap((figure) => figure.clips.map((clip) => clip.name)))];
  }

  /// Turns of a joint about x, y and z, in radians. Joints go by their names: not all bodies have the same ones.
  bend_of(name) {
    return this.bends.get(name) ?? [0, 0, 0];
  }

  bend(name, turns) {
    this.hold([[name, turns]]);
  }

  /// How far digits are curled, as the mean of their bends says: `digits` as `digits_beside` has them.
  curl_of(digits) {
    return digits.reduce((sum, { name, share }) => sum + this.bend_of(name)[0] / share, 0) / digits.length;
  }

  curl(digits, angle) {
    this.hold(digits.map(({ name, share }) => [name, [share * angle, ...this.bend_of(name).slice(1)]]));
  }

  hold(bends) {
    this.stop();
    for (const [name, turns] of bends) this.bends.set(name, turns);
    for (const figure of this.figures) figure.bend(figure.data.joints.map(({ name }) => this.bends.get(name)));
  }

  rest() {
    this.stop();
    this.bends.clear();
    for (const figure of this.figures) figure.bend([]);
  }

  stop() {
    for (const { mixer } of this.tracks) mixer.stopAllAction();
    this.tracks = [];
    this.clip = null;
    this.playing = false;
  }

  /// Holds the bodies that have the clip as they are at its beginning.
  choose(name) {
    this.rest();
    this.tracks = this.figures.flatMap((figure) => {
      const clip = figure.clips.find((one) => one.name === name);
      if (!clip) return [];
      const mixer = new THREE.AnimationMixer(figure.inner);
      mixer.clipAction(clip).play();
      return [{ figure, mixer, duration: clip.duration }];
    });
    this.clip = name;
    this.go_to(0);
  }

  /// Holds them at a part of a clip, the chosen one or else this.
  scrub(part, name) {
    if (this.clip === null) this.choose(name);
    this.playing = false;
    this.go_to(part * this.duration());
  }

  /// Plays what is chosen, or else this, or stops.
  play(name) {
    if (this.clips().length === 0) return;
    if (this.clip === null) this.choose(name);
    this.playing = !this.playing;
  }

  duration() {
    return Math.max(0, ...(this.tracks).map(({ duration }) => duration));
  }

  go_to(seconds) {
    this.time = seconds;
    for (const { figure, mixer, duration } of this.tracks) {
      mixer.setTime(duration > 0 ? Math.min(seconds, duration * (1 - 1e-6)) : 0); // at its end it would begin anew
      figure.follow();
    }
  }

  /// \returns whether something moved.
  advance(seconds) {
    if (!this.playing) return false;
    const duration = this.duration();
    if (duration > 0) this.go_to((this.time + seconds) % duration);
    return duration > 0; // a clip of one frame stands still
  }
}
