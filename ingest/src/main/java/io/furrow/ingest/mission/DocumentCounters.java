package io.furrow.ingest.mission;

import org.apache.flink.metrics.Counter;
import org.apache.flink.metrics.MetricGroup;

import io.furrow.flink.job.PerMissionMetrics;
import io.furrow.flink.record.DeadLetterCounters;
import io.furrow.model.ngsi.Reason;

/**
 * Counts documents that MongoDB acknowledged, {@code documents}, or refused, {@code dead}; in total and in groups per
 * {@code domain} and {@code mission}.
 */
final class DocumentCounters {
    private final Counter documents;
    private final PerMissionMetrics<Counter> perMissionMetrics;
    private final DeadLetterCounters dead;

    DocumentCounters(MetricGroup group) {
        documents = group.counter("documents");
        perMissionMetrics =
                new PerMissionMetrics<>(group, PerMissionMetrics.USUAL_LIMIT, mission -> mission.counter("documents"));
        dead = new DeadLetterCounters(group);
    }

    void written(MissionDocument document) {
        documents.inc();
        perMissionMetrics
                .of(document.event().domain(), document.event().mission())
                .inc();
    }

    void refused(MissionDocument document) {
        dead.count(Reason.REFUSED, document.event().domain(), document.event().mission());
    }
}
