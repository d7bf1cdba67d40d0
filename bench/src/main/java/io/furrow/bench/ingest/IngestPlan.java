package io.furrow.bench.ingest;

import java.time.Duration;

/**
 * What is measured.
 *
 * @param records of the input topic, all of which every turn reads
 * @param partitions of the input topic
 * @param devices that report, each once a second of event time
 * @param missions that the devices belong to
 * @param bytes of a record's value, about
 * @param turns of each job that count, after one that does not
 * @param parallelism of every job
 * @param checkpointInterval of every job
 */
public record IngestPlan(
        int records,
        int partitions,
        int devices,
        int missions,
        int bytes,
        int turns,
        int parallelism,
        Duration checkpointInterval) {}
