/**
 * The jobs {@code ingest} and {@code normalize}; their stages and branches have a package each.
 *
 * <p><b>In</b>: {@code data.raw}, {@code service.devices}; for {@code normalize} the notifications that a context
 * broker writes to Kafka.
 *
 * <p><b>Out</b>: topics of domains and missions, {@code data.latest}, {@code data.catalog}, {@code data.images},
 * missions in MongoDB, image files, dead letters.
 *
 * <p><b>Must not know</b>: what is computed from events.
 */
package io.furrow.ingest;
