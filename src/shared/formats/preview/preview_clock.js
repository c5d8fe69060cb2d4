// The preview's clock: the song's where the page has one that plays, otherwise its own.

const find = (id) => document.getElementById(id);
const DURATION = Math.max(...MOTIONS.map((motion) => motion.seconds));
const state = { time: 0, speed: 1, playing: false, loop: true, dirty: true };
const song = find("song");
const SNAP = 0.12; // seconds of difference that are jumped over instead of smoothed away
let silent = !song; // there is no song, or this browser cannot play it

/** True while the song sets the time: not after its end, should the motion be longer. */
function songLeads() {
  return !silent && !song.ended && !(state.time >= song.duration);
}

function show(time) {
  state.time = Math.min(Math.max(time, 0), DURATION);
  state.dirty = true;
}

/** Go to a time in seconds, the song with it. */
function seek(time) {
  show(time);
  if (silent) return;
  song.currentTime = state.time;
  if (state.playing && state.time < (song.duration || Infinity)) startSong();
}

function setPlaying(playing) {
  if (playing && state.time >= DURATION) seek(0);
  state.playing = playing;
  find("play").textContent = playing ? "Pause" : "Play";
  if (silent) return;
  if (playing && songLeads()) startSong();
  else song.pause();
}

function startSong() {
  // Refused before the first click or key; `error` tells of a song that cannot be played.
  song.play().catch((error) => { if (error.name === "NotAllowedError") setPlaying(false); });
}

/** Let some seconds of the page's time pass. */
function advance(seconds) {
  let next = state.time + state.speed * seconds;
  if (songLeads()) {
    // The song's time comes in steps of some milliseconds: follow it smoothly.
    const gap = song.currentTime - next, steady = song.readyState > 2 && !song.seeking;
    next = steady && Math.abs(gap) < SNAP ? next + 0.1 * gap : song.currentTime;
  }
  if (next < DURATION || DURATION === 0) return show(next);
  if (state.loop) return seek(0);
  show(DURATION);
  setPlaying(false);
}

function setSpeed(speed) {
  state.speed = speed;
  if (song) song.playbackRate = speed;
}

if (song) {
  song.addEventListener("pause", () => {
    // The event may come late: at a loop the song ends, and plays again before it is told.
    if (song.paused && !song.ended && !song.error && state.playing) setPlaying(false);
  });
  song.addEventListener("play", () => { if (!state.playing) setPlaying(true); });
  song.addEventListener("error", () => {
    silent = true;
    find("note").textContent = "This browser cannot play the song.";
  });
}
