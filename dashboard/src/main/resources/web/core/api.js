/** The REST API: JSON in, JSON out, with the user's token. */
import { t } from '../texts.js';
import { parse } from './json.js';

const TOKEN = 'furrow-token';

/** A refusal, or no answer; its message is for people. */
export class ApiError extends Error {
  /** @param {number} status of HTTP, 0 where nothing answered */
  constructor(status, code, message) {
    super(message);
    this.status = status;
    this.code = code;
  }
}

let token = sessionStorage.getItem(TOKEN);
const signedOut = new Set();

export const api = {
  get: (path, options) => request('GET', path, undefined, options),
  post: (path, body, options) => request('POST', path, body ?? {}, options),
  patch: (path, body, options) => request('PATCH', path, body, options),
  del: (path, options) => request('DELETE', path, undefined, options),
  /** The bare response, for pictures and streams. @throws {ApiError} */
  fetch: send,
  get token() {
    return token;
  },
  set token(value) {
    token = value || null;
    token ? sessionStorage.setItem(TOKEN, token) : sessionStorage.removeItem(TOKEN);
  },
  /** Calls back when a request was refused for want of a token. */
  onSignedOut(handler) {
    signedOut.add(handler);
    return () => signedOut.delete(handler);
  },
};

async function request(method, path, body, options) {
  const response = await send(path, { ...options, method, body });
  const text = await response.text();
  return text ? parse(text) : null;
}

async function send(path, { method = 'GET', body, headers = {}, signal } = {}) {
  const isJson = body !== undefined && !(body instanceof Blob);
  let response;
  try {
    response = await fetch(path, {
      method,
      signal,
      cache: 'no-store',
      headers: {
        // a proxy that signs users in answers 401 to who asks for JSON, and leads others to another page
        Accept: 'application/json, */*',
        ...(token ? { Authorization: `Bearer ${token}` } : {}),
        ...(isJson ? { 'Content-Type': 'application/json' } : {}),
        ...headers,
      },
      body: isJson ? JSON.stringify(body) : body,
    });
  } catch (error) {
    if (error.name === 'AbortError') {
      throw error;
    }
    throw new ApiError(0, 'no-answer', t('errors.noAnswer'));
  }
  if (!response.ok) {
    throw await refusal(response);
  }
  return response;
}

async function refusal(response) {
  let problem = {};
  try {
    problem = await response.json();
  } catch {
    // whatever stands between answered in its own words
  }
  if (response.status === 401) {
    signedOut.forEach((handler) => handler());
  }
  const reason = problem.reason ?? problem.detail ?? problem.message ?? t('errors.status', { status: response.status });
  return new ApiError(response.status, problem.error ?? problem.code ?? 'refused', reason);
}
