package io.furrow.analytics.clock;

import java.io.Serializable;

import io.furrow.flink.record.Epochs;
import io.furrow.flink.record.ResultRecord;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.result.ClockResult;
import io.furrow.model.topic.Topics;

/**
 * Describes clock reports as entities of their devices: {@code Analytics:ClockBehind:<device>} and
 * {@code Analytics:ClockOffset:<device>}.
 *
 * @param job that made the reports
 * @param topic of the entities; those of a replay go to its output topic
 */
record ClockEntity(String job, String topic) implements Serializable {
    /** Key = device id; timestamp = event time of the report. */
    TopicRecord of(ClockReport report) {
        String type = report.kind() == ClockReport.Kind.OFFSET ? ClockResult.OFFSET_TYPE : ClockResult.BEHIND_TYPE;
        EntityBuilder entity = Entity.builder(type + ":" + report.id(), type)
                .text(ClockResult.DEVICE, report.id())
                .text(ClockResult.DEVICE_TYPE, report.type())
                .text("job", job)
                .integer("time", Epochs.original(report.time()));
        switch (report.kind()) {
            case BEHIND -> describe(entity, report, "positions");
            case DELAYED -> describe(entity, report, ClockResult.REPORTS);
            case OFFSET -> entity.integer("offset", report.millis());
        }
        String output = Topics.resultOf(report.topic(), topic);
        return ResultRecord.of(output, report.id(), entity, report.scope(), report.time(), "/analytics/" + job);
    }

    private static void describe(EntityBuilder entity, ClockReport report, String what) {
        entity.integer(ClockResult.LATE, report.millis())
                .integer(what, report.positions())
                .integer(ClockResult.INTERVAL, report.interval())
                .text("Mission", report.mission());
    }
}
