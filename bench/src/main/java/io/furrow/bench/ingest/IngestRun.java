package io.furrow.bench.ingest;

import io.furrow.flink.job.Delivery;

/**
 * What one job did in one turn.
 *
 * @param turn from 1 on; the runs of one turn are compared
 * @param recordsPerSecond read, by when what becomes of them could be read
 * @param processorMicros that each of them took of this JVM, brokers included
 * @param stateBytes of a checkpoint when all was read; 0 of a job without state
 * @param missing records that are not on the topics of domain and missions; negative where some are there more than once
 */
public record IngestRun(
        ComparedJob peer,
        Delivery delivery,
        int turn,
        double recordsPerSecond,
        double processorMicros,
        long stateBytes,
        long missing) {}
