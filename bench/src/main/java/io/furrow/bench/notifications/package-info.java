/** Measures how fast the NGSI source writes notifications to Kafka, beside a server that only answers and a producer that only produces. */
package io.furrow.bench.notifications;
