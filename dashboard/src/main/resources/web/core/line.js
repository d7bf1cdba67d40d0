/** The newest points of a line: a number per column and point. Its memory is taken with the first point and does not grow. */
export class Line {
  /** @param {string[]} names of the columns, each a `Float64Array` of which the first `length` numbers count, oldest first */
  constructor(names, capacity) {
    this.names = names;
    this.capacity = capacity;
    this.length = 0;
    names.forEach((name) => (this[name] = new Float64Array(capacity)));
  }

  /** A number for each column; the oldest point goes where there is no room. */
  push(...point) {
    if (this.length === this.capacity) {
      this.names.forEach((name) => this[name].copyWithin(0, 1));
      this.length--;
    }
    this.names.forEach((name, column) => (this[name][this.length] = point[column]));
    this.length++;
  }

  /** @param {Line} older of the same columns; of it those points come in front, as many as there is room for, whose number in `column` is less than the first */
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

  /** A column's numbers. */
  of(name) {
    return this[name].subarray(0, this.length);
  }
}
