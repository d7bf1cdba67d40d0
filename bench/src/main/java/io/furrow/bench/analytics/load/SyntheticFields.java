package io.furrow.bench.analytics.load;

import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.field.FieldVersion;
import io.furrow.model.position.Position;
import io.furrow.model.topic.Topics;

/**
 * Generates fields side by side on a square grid of 0.01 degrees, each a wavy outline around the center of its cell that
 * fills about half of it; generated wherever they are read, so that only their number is serialized.
 */
public record SyntheticFields(int fields, int corners) implements TopicSnapshot {
    private static final double CELL = 0.01;
    private static final double WEST = -3.5;
    private static final double SOUTH = 40.3;

    @Override
    public List<TopicRecord> read() {
        List<TopicRecord> records = new ArrayList<>();
        for (int i = 0; i < fields; i++) {
            ObjectNode properties = JsonNodeFactory.instance.objectNode().put("Domain", "bench");
            FieldVersion field = new FieldVersion("field-" + i, 0, area(i), properties);
            byte[] key = field.key().getBytes(StandardCharsets.UTF_8);
            records.add(new TopicRecord(Topics.FIELDS, 0, i, 0, key, field.toBytes(), Map.of()));
        }
        return records;
    }

    /** Cells per side of the square. */
    private int side() {
        return (int) Math.ceil(Math.sqrt(fields));
    }

    private ObjectNode area(int field) {
        ArrayNode ring = JsonNodeFactory.instance.arrayNode();
        for (int corner = 0; corner <= corners; corner++) {
            double angle = 2 * Math.PI * (corner % corners) / corners;
            double radius = CELL * (0.4 + 0.05 * Math.sin(5 * angle + field));
            ring.addArray()
                    .add(WEST + CELL * (field % side() + 0.5) + radius * Math.cos(angle))
                    .add(SOUTH + CELL * (field / side() + 0.5) + radius * Math.sin(angle));
        }
        ObjectNode area = JsonNodeFactory.instance.objectNode().put("type", "Polygon");
        area.putArray("coordinates").add(ring);
        return area;
    }

    /** The n-th of positions spread evenly over the square. */
    public Position position(long n) {
        double acrossX = n * 0.7548776662466927 % 1;
        double acrossY = n * 0.5698402909980532 % 1;
        return new Position(SOUTH + CELL * side() * acrossY, WEST + CELL * side() * acrossX);
    }
}
