package io.furrow.analytics.field;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.field.FieldVersion;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;
import io.furrow.unchecked.Unchecked;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Records of {@code service.fields} as they stand on its one partition, one after the other. */
public final class FieldRecords {
    private final ArrayList<TopicRecord> records = new ArrayList<>();

    /** The square from 10, 50 to 20, 60 degrees. */
    public TopicRecord square(String id, long validFrom, String domain) {
        return area(id, validFrom, domain, "[[[[10,50],[20,50],[20,60],[10,60],[10,50]]]]");
    }

    /** @param coordinates of a MultiPolygon */
    public TopicRecord area(String id, long validFrom, String domain, String coordinates) {
        ObjectNode geometry = object("{\"type\":\"MultiPolygon\",\"coordinates\":" + coordinates + "}");
        ObjectNode properties = JsonNodeFactory.instance.objectNode();
        if (!domain.isEmpty()) {
            properties.put("Domain", domain);
        }
        return add(new FieldVersion(id, validFrom, geometry, properties));
    }

    public TopicRecord end(String id, long validFrom) {
        return add(new FieldVersion(id, validFrom, null, JsonNodeFactory.instance.objectNode()));
    }

    public TopicRecord takeAway(String id, long validFrom) {
        return add(new FieldVersion.Key(id, validFrom).toString(), null);
    }

    public TopicRecord add(String key, byte[] value) {
        byte[] bytes = key == null ? null : key.getBytes(UTF_8);
        TopicRecord record = new TopicRecord(Topics.FIELDS, 0, records.size(), 0, bytes, value, Map.of());
        records.add(record);
        return record;
    }

    private TopicRecord add(FieldVersion version) {
        return add(version.key(), version.toBytes());
    }

    public List<TopicRecord> all() {
        return List.copyOf(records);
    }

    /** What stands on the topic now; it travels no further than to an operator of this JVM. */
    public TopicSnapshot atStart() {
        return this::all;
    }

    private static ObjectNode object(String json) {
        return Unchecked.get(() -> (ObjectNode) NgsiJson.read(json.getBytes(UTF_8)));
    }
}
