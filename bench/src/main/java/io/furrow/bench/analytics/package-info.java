/** Measures updates per second of the analytics, beside bare loops that do the same work without Flink. */
package io.furrow.bench.analytics;
