package io.furrow.analytics.coverage;

import java.nio.charset.StandardCharsets;
import java.util.Base64;
import java.util.HexFormat;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;

import io.furrow.analytics.coverage.CoverageReport.Layer;
import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.record.Epochs;
import io.furrow.flink.record.ResultRecord;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.result.CoverageResult;
import io.furrow.model.result.ResultTypes;
import io.furrow.model.text.Sha256;
import io.furrow.model.topic.Topics;

/** Records of coverages and late positions: for the given topic, or for the output topic of the replay that they come from. */
final class CoverageRecord {
    private static final String SOURCE = "/analytics/coverage";
    private static final int ID_BYTES = 16;

    private CoverageRecord() {}

    /** An entity per mission, field and robot, and one for all robots together; key = the end of its id, timestamp = of the report. */
    static TopicRecord of(CoverageReport report, String topic) {
        Swath last = report.last();
        EntityBuilder entity = begin(report, CoverageResult.TYPE)
                .text(CoverageResult.DEVICE, last.ofRobot() ? last.to().id() : "")
                .text(CoverageResult.DEVICE_TYPE, last.ofRobot() ? last.to().type() : "")
                .integer(CoverageResult.START_TIME, Epochs.original(report.begin()))
                .integer(CoverageResult.END_TIME, Epochs.original(last.time()))
                .number(CoverageResult.HECTARES, report.hectares(report.covered()))
                .number(CoverageResult.SHARE, report.share())
                .number(CoverageResult.OVERLAP, report.hectares(report.overlapped()))
                .number(CoverageResult.FIELD_HECTARES, report.hectares(report.fieldCells()));
        numberOrNull(entity, CoverageResult.RATE, report.hectares(report.perHour()));
        if (!last.ofRobot()) {
            entity.number(CoverageResult.GAPS, report.hectares(report.gaps()));
            numberOrNull(entity, CoverageResult.TIME_LEFT, report.millisLeft());
        }
        return record(report, entity, topic);
    }

    /** The cells of all robots' coverage as an entity; key and timestamp as those of the coverage. */
    static TopicRecord layer(CoverageReport report, String topic) {
        Layer layer = report.layer();
        ArrayNode box = JsonNodeFactory.instance
                .arrayNode()
                .add(layer.west())
                .add(layer.south())
                .add(layer.east())
                .add(layer.north());
        EntityBuilder entity = begin(report, CoverageResult.LAYER_TYPE)
                .attribute(CoverageResult.BOX, "StructuredValue", box)
                .integer(CoverageResult.COLUMNS, layer.columns())
                .integer(CoverageResult.ROWS, layer.rows())
                .freeText(CoverageResult.RUNS, Base64.getEncoder().encodeToString(layer.runs()));
        return record(report, entity, topic);
    }

    private static EntityBuilder begin(CoverageReport report, String type) {
        Swath last = report.last();
        EntityBuilder entity = Entity.builder(type + ":" + id(last), type)
                .text(CoverageResult.FIELD, last.field().id())
                .integer(CoverageResult.FIELD_VERSION, last.field().validFrom())
                .text("Mission", last.to().mission())
                .integer(CoverageResult.TIME, Epochs.original(report.time()))
                .number(CoverageResult.CELL, report.cell());
        if (!last.field().name().isEmpty()) {
            entity.freeText(CoverageResult.FIELD_NAME, last.field().name());
        }
        if (!last.field().domain().isEmpty()) {
            entity.freeText("Domain", last.field().domain());
        }
        return entity;
    }

    private static TopicRecord record(CoverageReport report, EntityBuilder entity, String topic) {
        PositionFix fix = report.last().to();
        String output = Topics.resultOf(fix.topic(), topic);
        return ResultRecord.of(output, id(report.last()), entity, fix.scope(), report.time(), SOURCE);
    }

    /** Null if it is unknown: the value of an earlier report must not remain. */
    private static void numberOrNull(EntityBuilder entity, String name, double value) {
        if (Double.isNaN(value)) {
            entity.attribute(name, "Float", JsonNodeFactory.instance.nullNode());
        } else {
            entity.number(name, value);
        }
    }

    /** The position as an entity of the device's id; key = id, timestamp = when the device was there. */
    static TopicRecord late(PositionFix fix, String topic) {
        EntityBuilder entity =
                Entity.builder(fix.id(), ResultTypes.LATE_POSITION).integer("Time", Epochs.original(fix.time()));
        if (!Double.isNaN(fix.latitude())) {
            entity.number("Latitude", fix.latitude()).number("Longitude", fix.longitude());
        }
        entity.text("Mission", fix.mission());
        return ResultRecord.of(Topics.resultOf(fix.topic(), topic), fix.id(), entity, fix.scope(), fix.time(), SOURCE);
    }

    /** The first 128 bits of a SHA-256 over tenant, mission, field and robot, in lower-case hexadecimal. */
    private static String id(Swath last) {
        return HexFormat.of().formatHex(Sha256.of(last.name().getBytes(StandardCharsets.UTF_8)), 0, ID_BYTES);
    }
}
