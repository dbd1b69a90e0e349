// Sound and notification of pairs that are new: on request alone.
import type { DrawnPair } from "./scene.ts";

/** Frequencies of the tones that follow each other. Unit: hertz. */
const tones = { predicted: [660, 880], within: [1175, 880, 1175] } as const;
const toneSeconds = 0.16;

export interface AlarmActions {
  /** Returns title and text for a pair. */
  wordsOf(pair: DrawnPair): { title: string; text: string };
  /** Called when the user chooses the notification of a pair. */
  choose(key: string): void;
}

export class Alarm {
  isOn = false;
  /** How often tones were played and notifications shown. */
  sounded = 0;
  notified = 0;
  private sound: AudioContext | null = null;
  /** Pairs of the latest state, with what they were; null before the first. */
  private known: Map<string, keyof typeof tones> | null = null;

  constructor(private readonly actions: AlarmActions) {
    // Browsers play nothing before the user has touched the page.
    for (const name of ["pointerdown", "keydown"] as const)
      addEventListener(name, () => {
        if (this.isOn) void this.sound?.resume();
      });
  }

  /** Call it because the user wants it: the browser asks for permission to show notifications. */
  async turnOn(): Promise<void> {
    this.isOn = true;
    this.play("predicted");
    if (typeof Notification !== "undefined" && Notification.permission === "default") await Notification.requestPermission();
  }
  /** Restores what was on at the last visit: without sound until the page is touched, and without a question. */
  restore(): void {
    this.isOn = true;
  }
  turnOff(): void {
    this.isOn = false;
    void this.sound?.suspend();
  }

  /** Returns what the browser allows, in words. */
  get text(): string {
    if (!this.isOn) return "Off.";
    if (typeof Notification === "undefined") return "Sound alone: this browser shows no notifications here.";
    return Notification.permission === "granted" ? "Sound and notifications." : "Sound alone: the browser does not allow notifications.";
  }

  /** Takes the pairs of a new state; the most urgent first. Those of the first state are not new. */
  take(pairs: readonly DrawnPair[]): void {
    const now = new Map<string, keyof typeof tones>();
    const fresh: DrawnPair[] = [];
    for (const pair of pairs) {
      const kind = pair.pair.verdict === "within" ? "within" : pair.isPredicted ? "predicted" : null;
      if (kind === null) continue;
      now.set(pair.key, kind);
      const before = this.known?.get(pair.key);
      if (this.known !== null && before !== kind && before !== "within") fresh.push(pair);
    }
    this.known = now;
    if (!this.isOn || fresh.length === 0) return;
    this.play(fresh.some(({ key }) => now.get(key) === "within") ? "within" : "predicted");
    this.notify(fresh[0]!, fresh.length - 1);
  }

  private play(kind: keyof typeof tones): void {
    try {
      this.sound ??= new AudioContext();
    } catch {
      return;
    }
    const { sound } = this;
    void sound.resume();
    this.sounded += 1;
    tones[kind].forEach((frequency, k) => {
      const tone = sound.createOscillator();
      const volume = sound.createGain();
      const start = sound.currentTime + 0.02 + k * toneSeconds;
      tone.frequency.value = frequency;
      // Without steps, which would click.
      volume.gain.setValueAtTime(0, start);
      volume.gain.linearRampToValueAtTime(0.2, start + 0.02);
      volume.gain.setValueAtTime(0.2, start + toneSeconds - 0.04);
      volume.gain.linearRampToValueAtTime(0, start + toneSeconds);
      tone.connect(volume).connect(sound.destination);
      tone.start(start);
      tone.stop(start + toneSeconds);
    });
  }

  private notify(pair: DrawnPair, others: number): void {
    if (typeof Notification === "undefined" || Notification.permission !== "granted") return;
    const { title, text } = this.actions.wordsOf(pair);
    try {
      const shown = new Notification(title, { body: others > 0 ? `${text}; and ${others} more` : text, tag: pair.key });
      this.notified += 1;
      shown.addEventListener("click", () => {
        window.focus();
        this.actions.choose(pair.key);
        shown.close();
      });
    } catch {
      // Browsers of phones show notifications of installed pages alone.
    }
  }
}
