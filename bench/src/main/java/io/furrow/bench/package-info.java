/**
 * Measurements, each beside a peer that does the least that the same work needs.
 *
 * <p><b>In</b>: sizes, rates and durations.
 *
 * <p><b>Out</b>: figures with the machine's calibration.
 *
 * <p><b>Must not know</b>: the command line; {@code io.furrow.bench.command} starts them.
 */
package io.furrow.bench;
