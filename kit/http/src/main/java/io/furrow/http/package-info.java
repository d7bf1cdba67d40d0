/**
 * Decides which requests an HTTP server answers, by the host that they name and the page that sent them. The rule
 * itself is plain Java; {@code jetty}, {@code connect} and {@code flink} each apply it to one engine and do not know
 * each other.
 *
 * <p><b>In</b>: the {@code Host} and {@code Origin} of a request.
 *
 * <p><b>Out</b>: pass, or a rejection with its reason.
 *
 * <p><b>Must not know</b>: users, tokens, any other module.
 */
package io.furrow.http;
