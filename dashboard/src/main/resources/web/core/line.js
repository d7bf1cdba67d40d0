/** A ring of the newest points, with one number per column and point. Allocates its memory with the first point. */
export class Line {
  /** @param {string[]} names of the columns, each a `Float64Array` of which the first `length` numbers are used, oldest first */
  constructor(names, capacity) {
    this.names = names;
    this.capacity = capacity;
    this.length = 0;
    names.forEach((name) => (this[name] = new Float64Array(capacity)));
  }

  /** Adds a point, a number for each column; removes the oldest point if it is full. */
  push(...point) {
    if (this.length === this.capacity) {
      this.names.forEach((name) => this[name].copyWithin(0, 1));
      this.length--;
    }
    this.names.forEach((name, column) => (this[name][this.length] = point[column]));
    this.length++;
  }

  /**
   * Prepends older points whose number in `column` is less than the first, as many as there is room for. @param {Line} older with the same columns
   */
  prepend(older, column) {
    const first = this.length === 0 ? Infinity : this[column][0];
    let count = 0;
    while (count < older.length && older[column][count] < first) {
      count++;
    }
    const room = Math.min(count, this.capacity - this.length);
    for (const name of room > 0 ? this.names : []) {
      this[name].copyWithin(room, 0, this.length);
      this[name].set(older[name].subarray(count - room, count));
    }
    this.length += room;
  }

  /** The numbers of a column. */
  of(name) {
    return this[name].subarray(0, this.length);
  }
}
