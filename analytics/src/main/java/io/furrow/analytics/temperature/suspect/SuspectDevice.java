package io.furrow.analytics.temperature.suspect;

/**
 * A device that was set aside in this many windows in a row that it is reported.
 *
 * @param since start of the first of these windows, epoch ms
 */
public record SuspectDevice(Verdict last, int windows, long since) {}
