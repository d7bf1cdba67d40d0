package io.furrow.cli.compare;

import java.util.Collection;
import java.util.EnumMap;
import java.util.EnumSet;
import java.util.List;
import java.util.Map;
import java.util.OptionalLong;
import java.util.Set;

import org.apache.kafka.common.KafkaException;

import io.furrow.cli.option.CommandException;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.FailureText;

/** Reads the results of a side. */
final class ResultReader {
    private final ResultTopics topics;
    private final Collection<String> names;

    ResultReader(ResultTopics topics) {
        this.topics = topics;
        this.names = topics.names();
    }

    /** Names of all topics. */
    Collection<String> topics() {
        return names;
    }

    /**
     * @param desired epoch of a replay; empty for its newest
     * @param mission see {@link ResultCollector}
     * @param from begin of the range to compare, event time in epoch ms
     * @throws CommandException if a record is not an entity, or Kafka does not answer
     */
    SideResults read(Side side, OptionalLong desired, String mission, long from) {
        try {
            OptionalLong epoch = side.isLive() ? OptionalLong.of(0) : desired.isPresent() ? desired : newestEpoch(side);
            ResultCollector collector = new ResultCollector(mission);
            Set<ResultKind> missing = EnumSet.noneOf(ResultKind.class);
            for (ResultKind kind : ResultKind.values()) {
                if (names.contains(side.results(kind))) {
                    // A span that is compared may have begun before; a window that is compared has its time in the
                    // range.
                    boolean isBounded = side.isLive() && kind == ResultKind.AVERAGES;
                    topics.read(
                            side.results(kind),
                            isBounded ? from : Long.MIN_VALUE,
                            record -> collect(side, kind, epoch, record, collector));
                } else {
                    missing.add(kind);
                }
            }
            Map<ResultKind, List<AnalyticsResult>> spans = new EnumMap<>(ResultKind.class);
            for (ResultKind kind : ResultKind.values()) {
                spans.put(kind, collector.spans(kind));
            }
            return new SideResults(side.name(), epoch.orElse(collector.epoch()), spans, missing);
        } catch (KafkaException e) {
            throw new CommandException(
                    "The results of %s cannot be read: %s".formatted(side.name(), FailureText.of(e)), e);
        }
    }

    private static void collect(
            Side side, ResultKind kind, OptionalLong epoch, ResultRecord record, ResultCollector collector) {
        long ofEpoch = side.isLive() ? 0 : record.epoch();
        if (record.value() != null && (epoch.isEmpty() || epoch.getAsLong() == ofEpoch)) {
            collector.add(kind, ofEpoch, record.scope(), entity(record));
        }
    }

    /** The epoch of the last replayed record: an epoch may be without results. */
    private OptionalLong newestEpoch(Side side) {
        long[] newest = {-1};
        if (names.contains(side.topic())) {
            topics.readNewest(side.topic(), record -> newest[0] = Math.max(newest[0], record.epoch()));
        }
        return newest[0] < 0 ? OptionalLong.empty() : OptionalLong.of(newest[0]);
    }

    private static Entity entity(ResultRecord record) {
        try {
            return Entity.parse(record.value());
        } catch (UnreadableException e) {
            throw new CommandException(
                    "%s is not an entity: %s. Check who else writes to the topic."
                            .formatted(record.place(), e.getMessage()),
                    e);
        }
    }
}
