package io.furrow.bench.load;

import java.util.List;

/**
 * One second of a load.
 *
 * @param second since the first message
 * @param atDevice messages sent in it
 * @param atSource messages that the source received in it; likewise the others
 * @param delays mean delay from device to source, source to ingest and ingest to reader of the messages sent in it, ms; empty without
 *     messages
 */
public record LoadSecond(
        long second, long atDevice, long atSource, long atIngest, long atReader, List<Double> delays) {}
