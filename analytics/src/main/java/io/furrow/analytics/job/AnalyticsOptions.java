package io.furrow.analytics.job;

import java.time.Duration;
import java.util.Optional;
import java.util.Set;

import picocli.CommandLine.Mixin;

import io.furrow.flink.job.AlignmentOptions;
import io.furrow.flink.job.JobOptions;
import io.furrow.flink.kafka.TopicOptions;
import io.furrow.model.result.AnalyticsKind;

/** Options of every analytics job. An accessor rejects an invalid value. */
public abstract class AnalyticsOptions extends JobOptions {
    @Mixin
    private final TopicOptions topics = new TopicOptions();

    @Mixin
    private final AlignmentOptions alignment = new AlignmentOptions();

    @Mixin
    private final ResultTopics results;

    private final AnalyticsKind kind;

    protected AnalyticsOptions(AnalyticsKind kind) {
        this.kind = kind;
        results = new ResultTopics(kind.topic(), kind.lateTopic());
    }

    public AnalyticsKind kind() {
        return kind;
    }

    /** Settings of the topics that the job creates. */
    public TopicOptions topics() {
        return topics;
    }

    /** The maximum drift of event time between partitions; empty for no limit. */
    public Optional<Duration> maxDrift() {
        return alignment.maxDrift();
    }

    /** Output topics that retain the newest record of each key forever. */
    public Set<String> compacted() {
        return Set.of();
    }

    public String output() {
        return results.output;
    }

    public String lateOutput() {
        return results.lateOutput;
    }

    public String clockOutput() {
        return results.clockOutput;
    }
}
