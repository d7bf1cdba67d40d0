package io.furrow.analytics.temperature;

import java.io.Serializable;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;

import io.furrow.flink.record.Epochs;
import io.furrow.flink.record.ResultRecord;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.result.FieldResult;
import io.furrow.model.topic.Topics;

/**
 * Describes results as entities, named after the attribute with its first letter in upper case: of {@code soilMoisture} the
 * entity {@code Analytics:FieldSoilMoisture:<field>} of type {@code Analytics:FieldSoilMoisture} with the attribute
 * {@code averageSoilMoisture}, so that two attributes of a field are two entities of the context broker. Each window replaces
 * the entity's attributes. All values are in the unit in which the devices report.
 *
 * @param attribute that was averaged
 * @param topic of the results; those of a replay go to its output topic
 */
record ResultEntity(String attribute, String topic) implements Serializable {
    private static final String SOURCE = "/analytics/temperature";

    /** Key = field id; timestamp = the window's last instant, so that each window falls into its hour. */
    TopicRecord of(FieldAverage result) {
        String type = FieldResult.TYPE_PREFIX + title();
        RobustMean average = result.average();
        EntityBuilder entity =
                Entity.builder(type + ":" + result.field(), type).text(FieldResult.FIELD, result.field());
        number(entity, FieldResult.average(title()), average.mean());
        number(entity, "plainMean", average.plainMean());
        number(entity, "spread", average.spread());
        entity.integer(FieldResult.DEVICES, average.devices())
                .texts(FieldResult.SUSPECTS, average.suspects())
                .texts(FieldResult.SUSPECT_TYPES, result.suspectTypes())
                .integer(FieldResult.WINDOW_START, original(result.windowStart(), result.windowEnd()))
                .integer(FieldResult.WINDOW_END, original(result.windowEnd(), result.windowEnd()))
                .text(FieldResult.QUALITY, average.verified() ? FieldResult.ROBUST : FieldResult.UNVERIFIED);
        if (!result.domain().isEmpty()) {
            entity.freeText("Domain", result.domain());
        }
        String output = Topics.resultOf(result.scope().topic(), topic);
        return ResultRecord.of(output, result.field(), entity, result.scope().fiware(), result.windowEnd() - 1, SOURCE);
    }

    /** Original time, relative to the epoch of a window, the first of which may begin before 1970. */
    private static long original(long time, long windowEnd) {
        return time - Epochs.begin(windowEnd - 1);
    }

    /** Null if there was nothing to average: the value of an earlier window must not remain beside this one's. */
    private static void number(EntityBuilder entity, String name, double value) {
        if (Double.isNaN(value)) {
            entity.attribute(name, "Float", JsonNodeFactory.instance.nullNode());
        } else {
            entity.number(name, value);
        }
    }

    private String title() {
        return FieldResult.title(attribute);
    }
}
