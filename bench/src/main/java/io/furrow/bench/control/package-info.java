/** Measures the managers of the control plane under a load of requests, over Kafka and over REST. */
package io.furrow.bench.control;
