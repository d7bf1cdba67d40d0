package io.furrow.bench.analytics;

import java.nio.charset.StandardCharsets;

import org.apache.kafka.clients.producer.ProducerRecord;

import io.furrow.analytics.collision.PositionFix;
import io.furrow.model.event.HeaderNames;

/** A fix as the entity of a robot in the form in which the NGSI source writes it. */
final class RobotJson {
    private static final byte[] SERVICE = "farm".getBytes(StandardCharsets.UTF_8);
    private static final byte[] SERVICE_PATH = "/".getBytes(StandardCharsets.UTF_8);

    private static final long DECIMALS = 10_000_000;

    private RobotJson() {}

    /** @param time of the record, epoch milliseconds */
    static ProducerRecord<byte[], byte[]> record(String topic, PositionFix fix, long time) {
        ProducerRecord<byte[], byte[]> record = new ProducerRecord<>(
                topic, null, time, fix.id().getBytes(StandardCharsets.ISO_8859_1), bytes(fix, time));
        record.headers().add(HeaderNames.SERVICE, SERVICE).add(HeaderNames.SERVICE_PATH, SERVICE_PATH);
        return record;
    }

    private static byte[] bytes(PositionFix fix, long time) {
        StringBuilder json = new StringBuilder(400)
                .append("{\"id\":\"")
                .append(fix.id())
                .append(
                        "\",\"type\":\"Robot\",\"location\":{\"type\":\"geo:json\",\"value\":{\"type\":\"Point\",\"coordinates\":[");
        appendDegrees(json, fix.longitude());
        json.append(',');
        appendDegrees(json, fix.latitude());
        return json.append("]},\"metadata\":{}},\"Status\":{\"type\":\"Boolean\",\"value\":true,\"metadata\":{}},")
                .append("\"Battery\":{\"type\":\"Float\",\"value\":0.87,\"metadata\":{}},")
                .append("\"Time\":{\"type\":\"Integer\",\"value\":")
                .append(time)
                .append(",\"metadata\":{}}}")
                .toString()
                .getBytes(StandardCharsets.ISO_8859_1);
    }

    /** With seven decimals, a centimetre, as receivers tell them. */
    private static void appendDegrees(StringBuilder json, double degrees) {
        long units = Math.round(Math.abs(degrees) * DECIMALS);
        json.append(degrees < 0 ? "-" : "").append(units / DECIMALS).append('.');
        String decimals = Long.toString(DECIMALS + units % DECIMALS);
        json.append(decimals, 1, decimals.length());
    }
}
