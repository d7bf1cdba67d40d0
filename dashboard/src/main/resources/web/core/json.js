/** JSON whose numbers are not changed by being read. */

/** Digits of a whole number that may be beyond 2^53, or an exponent that may be: a hint, texts may hold them too. */
const HUGE = /(?<![\d.])[1-9]\d{15}|[eE]\+?\d{3}/;
const TEXT_OR_NUMBER = /"[^"\\]*(?:\\.[^"\\]*)*"|-?\d+(?:\.\d+)?(?:[eE][+-]?\d+)?/gs;
const WHOLE = /^-?\d+$/;

/** Numbers that no double holds, whole ones beyond 2^53 and those that would be infinite, come as the text of their digits. */
export function parse(text) {
  return JSON.parse(HUGE.test(text) ? text.replace(TEXT_OR_NUMBER, (token) => (isLost(token) ? `"${token}"` : token)) : text);
}

function isLost(token) {
  const number = token.startsWith('"') ? 0 : Number(token);
  return !Number.isFinite(number) || (WHOLE.test(token) && !Number.isSafeInteger(number));
}
