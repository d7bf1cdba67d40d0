/** Records between operators: their serializer, dead letters, the epochs of replays. */
package io.furrow.flink.record;
