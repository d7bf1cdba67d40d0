/** Saves what the page made as a file. */

/** @param {Blob} blob @param {string} name of the file; characters that no file may have are replaced */
export function download(blob, name) {
  const url = URL.createObjectURL(blob);
  Object.assign(document.createElement('a'), { href: url, download: name.replace(/[^\p{L}\p{N}._-]+/gu, '-') }).click();
  setTimeout(() => URL.revokeObjectURL(url), 60_000); // the browser may still read it
}

/** Lines of cells as CSV (RFC 4180). A text that a spreadsheet would take for a formula gets an apostrophe. */
export function csv(lines) {
  const cell = (value) => {
    const text = typeof value === 'string' && /^[=+\-@\t\r]/.test(value) ? `'${value}` : String(value);
    return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  };
  return new Blob([lines.map((cells) => `${cells.map(cell).join(',')}\r\n`).join('')], { type: 'text/csv;charset=utf-8' });
}
