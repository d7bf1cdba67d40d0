/** How fast the NGSI source takes notifications into Kafka, beside a server that only answers and a producer that only produces. */
package io.furrow.bench.notifications;
