// The one object that stands for a body, wherever tact gives its id out.
const nameOf = ({ index, generation, world }) => `${index} ${generation} ${world}`;
const forgotten = new FinalizationRegistry(([earlier, name]) => {
  if (!earlier.get(name)?.deref()) earlier.delete(name);
});

/** The bodies of one world. Kept reports and ends of contacts name removed ones, too. */
export class Bodies {
  #latest = new Map();   // by index
  #earlier = new Map();  // by name, those whose index another body has, as long as the program names them

  of(id) {
    if (id.generation === 0) return null;
    const latest = this.#latest.get(id.index), name = nameOf(id);
    if (latest && nameOf(latest) === name) return latest;
    const body = this.#earlier.get(name)?.deref() ?? Object.freeze({ index: id.index, generation: id.generation, world: id.world });
    if (latest && latest.generation > body.generation) {
      this.#remember(body);
    } else {
      if (latest) this.#remember(latest);
      this.#latest.set(body.index, body);
    }
    return body;
  }
  #remember(body) {
    const name = nameOf(body);
    if (this.#earlier.get(name)?.deref()) return;
    this.#earlier.set(name, new WeakRef(body));
    forgotten.register(body, [this.#earlier, name]);
  }
  /** The latest body with an index that was given out. */
  latest(index) { return this.#latest.get(index); }
  /** What a restored state calls its bodies may be earlier than what came after. */
  restored() {
    for (const body of this.#latest.values()) this.#remember(body);
    this.#latest.clear();
  }
}
