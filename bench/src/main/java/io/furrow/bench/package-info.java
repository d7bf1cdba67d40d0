/**
 * Measurements, each beside a minimal peer that does the same work.
 *
 * <p><b>In</b>: sizes, rates and durations.
 *
 * <p><b>Out</b>: figures with the machine's calibration.
 *
 * <p><b>Must not know</b>: the command line; {@code io.furrow.bench.command} starts them.
 */
package io.furrow.bench;
