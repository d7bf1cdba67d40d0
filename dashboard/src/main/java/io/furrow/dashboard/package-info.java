/**
 * Stands between browsers and the rest of Furrow: serves topics as streams, the REST API under the same origin, and the
 * page.
 *
 * <p><b>In</b>: topics of Kafka, requests of browsers.
 *
 * <p><b>Out</b>: WebSockets and server-sent events, requests to the managers in the name of a user, files of the page.
 *
 * <p><b>Must not know</b>: the meaning of records, which only the page knows.
 */
package io.furrow.dashboard;
