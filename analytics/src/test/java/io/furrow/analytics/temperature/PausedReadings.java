package io.furrow.analytics.temperature;

import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CompletionStage;
import java.util.concurrent.atomic.AtomicLong;

import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.api.connector.source.util.ratelimit.RateLimiter;
import org.apache.flink.connector.datagen.source.DataGeneratorSource;
import org.apache.flink.connector.datagen.source.GeneratorFunction;

import io.furrow.flink.TopicRecord;

/** A source that pauses before a record, so that a savepoint can be taken there; restored it goes on. One run at a time. */
final class PausedReadings {
    private static volatile List<TopicRecord> records;

    private PausedReadings() {}

    /**
     * @param from where the run begins, as its savepoint knows too
     * @param until before which record it pauses; their number for none
     */
    static DataGeneratorSource<TopicRecord> of(List<TopicRecord> all, long from, long until) {
        records = all;
        GeneratorFunction<Long, TopicRecord> nth = index -> records.get(index.intValue());
        long before = until < all.size() ? until - from : Long.MAX_VALUE; // whoever looks for the end asks once more
        return new DataGeneratorSource<>(
                nth, all.size(), subtasks -> pausing(before), TypeInformation.of(TopicRecord.class));
    }

    private static <S extends org.apache.flink.api.connector.source.SourceSplit> RateLimiter<S> pausing(long after) {
        AtomicLong left = new AtomicLong(after);
        return new RateLimiter<>() {
            @Override
            public CompletionStage<Void> acquire(int requested) {
                return left.addAndGet(-requested) >= 0
                        ? CompletableFuture.completedFuture(null)
                        : new CompletableFuture<>();
            }
        };
    }
}
