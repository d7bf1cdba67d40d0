/** Generates fleets of devices as input of the measurements. */
package io.furrow.bench.analytics.load;
