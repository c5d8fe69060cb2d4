// What there is to choose from: sentences in the model's languages, ways on the floor.

const EXAMPLES = {
  en: ["a person walks forward", "a person waves with the right hand", "a person jumps"],
  es: ["una persona corre", "una persona salta"],
  fr: ["une personne salue de la main", "une personne marche"],
  de: ["eine Person verbeugt sich", "eine Person geht drei Meter und winkt dann"],
  ja: ["人が歩く", "人が右手を振る"],
  zh: ["一个人向前走", "一个人跳"],
};

export const examples = (languages) =>
  languages.flatMap((language) => (EXAMPLES[language] ?? []).map((prompt) => ({ language, prompt })));

const arc = (radius, from, to, number) =>
  Array.from({ length: number }, (_, i) => {
    const angle = from + ((to - from) * i) / (number - 1);
    return [radius - radius * Math.cos(angle), radius * Math.sin(angle)].map((x) => Math.round(x * 100) / 100 + 0);
  });

export const PATHS = {
  none: { label: "its own way", points: null },
  draw: { label: "draw one …" },
  straight: { label: "straight, 4 m", points: [[0, 0], [0, 4]] },
  left: { label: "a bend to the left", points: arc(2, 0, Math.PI / 2, 12) },
  circle: { label: "a circle, 3 m across", points: arc(1.5, 0, 2 * Math.PI, 25) },
  zigzag: { label: "a zigzag", points: [[0, 0], [0.8, 1.2], [-0.8, 2.4], [0, 3.6]] },
  drawn: { label: "as drawn" },
  clip: { label: "none with a clip" },
};
