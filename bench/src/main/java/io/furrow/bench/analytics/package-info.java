/** How many updates per second the analytics take, beside bare loops that do the same work without Flink. */
package io.furrow.bench.analytics;
