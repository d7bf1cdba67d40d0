/**
 * The server between browsers and the rest of Furrow: topics as streams, the REST API under the same origin, the page.
 *
 * <p><b>In</b>: topics of Kafka, requests of browsers.
 *
 * <p><b>Out</b>: WebSockets and server-sent events, requests to the managers in the name of a user, files of the page.
 *
 * <p><b>Must not know</b>: what the records mean: that is the page's part.
 */
package io.furrow.dashboard;
