/** The access rule for the REST API of Kafka Connect 4. */
package io.furrow.http.connect;
