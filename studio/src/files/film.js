// A film of the stage, recorded as it plays.

const KINDS = ["video/mp4;codecs=avc1.42E01F", "video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm"];

/** Plays `seconds` once by calling `seek`, as long as that gives true, and gives { blob, kind }. */
export async function recordFilm(canvas, seconds, seek) {
  const type = globalThis.MediaRecorder && KINDS.find((kind) => MediaRecorder.isTypeSupported(kind));
  if (!type || !canvas.captureStream) throw new Error("This browser records no films.");
  const recorder = new MediaRecorder(canvas.captureStream(60), { mimeType: type, videoBitsPerSecond: 6e6 }), pieces = [];
  recorder.ondataavailable = ({ data }) => pieces.push(data);
  const ended = new Promise((resolve) => { recorder.onstop = resolve; });
  seek(0);
  recorder.start();
  const began = performance.now();
  await new Promise((resolve) => {
    const step = (now) => {
      const time = (now - began) / 1000;
      if (seek(Math.min(Math.max(time, 0), seconds)) && time < seconds + 0.2) requestAnimationFrame(step);
      else resolve();
    };
    requestAnimationFrame(step);
  });
  recorder.stop();
  await ended;
  return { blob: new Blob(pieces, { type: type.split(";")[0] }), kind: type.includes("mp4") ? "mp4" : "webm" };
}
