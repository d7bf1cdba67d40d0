/** Parses JSON without changing numbers. */

/** Digits of an integer that may exceed 2^53, or of a large exponent: a hint only, since texts may contain them too. */
const HUGE = /(?<![\d.])[1-9]\d{15}|[eE]\+?\d{3}/;
const TEXT_OR_NUMBER = /"[^"\\]*(?:\\.[^"\\]*)*"|-?\d+(?:\.\d+)?(?:[eE][+-]?\d+)?/gs;
const WHOLE = /^-?\d+$/;

/** Returns numbers that no double can represent as text: integers beyond 2^53, and those that would be infinite. */
export function parse(text) {
  return JSON.parse(HUGE.test(text) ? text.replace(TEXT_OR_NUMBER, (token) => (losesPrecision(token) ? `"${token}"` : token)) : text);
}

function losesPrecision(token) {
  const number = token.startsWith('"') ? 0 : Number(token);
  return !Number.isFinite(number) || (WHOLE.test(token) && !Number.isSafeInteger(number));
}
