/**
 * Decides which requests an HTTP server answers, by the host that they name and the page that sent them. The rule itself is plain Java;
 * {@code jetty}, {@code connect} and {@code flink} each apply it to one engine and do not know each other.
 */
package io.furrow.http;
