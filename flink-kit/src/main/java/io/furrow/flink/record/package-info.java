/** Records between operators: their serializer, dead letters, deduplication. */
package io.furrow.flink.record;
