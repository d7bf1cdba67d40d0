/** Calls the REST API with the user's token; requests and responses are JSON. */
import { refusal, t } from '../texts.js';
import { parse } from './json.js';

const TOKEN = 'furrow-token';

/** A rejected request, or one without a response; its message is for users. */
export class ApiError extends Error {
  /** @param {number} status HTTP status, 0 without a response */
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
  /** The response itself, for images and streams. @throws {ApiError} */
  fetch: send,
  get token() {
    return token;
  },
  set token(value) {
    token = value || null;
    token ? sessionStorage.setItem(TOKEN, token) : sessionStorage.removeItem(TOKEN);
  },
  /** Adds a handler for requests that are rejected because the token is missing or invalid. */
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
        // for JSON a proxy that signs users in answers 401; other requests it redirects to its page
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
    throw await errorOf(response);
  }
  return response;
}

async function errorOf(response) {
  let problem = {};
  try {
    problem = await response.json();
  } catch {
    // a server in between answered without JSON
  }
  if (response.status === 401) {
    signedOut.forEach((handler) => handler());
  }
  const reason = problem.reason ?? problem.detail ?? problem.message ?? t('errors.status', { status: response.status });
  const code = problem.error ?? problem.code ?? 'refused';
  return new ApiError(response.status, code, refusal(code, reason));
}
