/** Saves what the page made as a file. */

/** @param {Blob} blob @param {string} name of the file; characters that no file may have are replaced */
export function download(blob, name) {
  const url = URL.createObjectURL(blob);
  Object.assign(document.createElement('a'), { href: url, download: name.replace(/[^\p{L}\p{N}._-]+/gu, '-') }).click();
  setTimeout(() => URL.revokeObjectURL(url), 60_000); // the browser may still read it
}
