/** Elements of the page. Texts go in as texts, never as HTML. */

export function element<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag, properties: object, ...inside: (Node | string)[]
): HTMLElementTagNameMap[Tag] {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...inside);
  return made;
}

/** The element that live.html has under this id. */
export function place<Kind extends Element = HTMLElement>(id: string): Kind {
  return document.getElementById(id) as unknown as Kind;
}

/** A colour of live.css, as it is now. */
export function colour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name);
}

/** Calls `act` once nothing has been asked for `wait` ms. */
export function settled(act: () => void, wait: number): () => void {
  let timer = 0;
  return () => {
    clearTimeout(timer);
    timer = window.setTimeout(act, wait);
  };
}
