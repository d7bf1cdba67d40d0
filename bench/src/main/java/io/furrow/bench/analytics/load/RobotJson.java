package io.furrow.bench.analytics.load;

import java.math.BigDecimal;
import java.nio.charset.StandardCharsets;

import org.apache.kafka.clients.producer.ProducerRecord;

import io.furrow.analytics.position.PositionFix;
import io.furrow.model.event.HeaderNames;

/** Encodes a fix as the entity of a robot, as the NGSI source writes it. */
final class RobotJson {
    private static final byte[] SERVICE = ascii("farm");
    private static final byte[] SERVICE_PATH = ascii("/");

    private RobotJson() {}

    /** @param time of the record, epoch milliseconds */
    static ProducerRecord<byte[], byte[]> record(String topic, PositionFix fix, long time) {
        return padded(topic, null, fix, time, 0);
    }

    /** The same with an attribute {@code Notes} of the given length, on a partition. */
    static ProducerRecord<byte[], byte[]> padded(
            String topic, Integer partition, PositionFix fix, long time, int characters) {
        // Concatenated by hand, because formatting costs more than sending.
        StringBuilder json = new StringBuilder(400 + characters)
                .append("{\"id\":\"")
                .append(fix.id())
                .append(
                        "\",\"type\":\"Robot\",\"location\":{\"type\":\"geo:json\",\"value\":{\"type\":\"Point\",\"coordinates\":[")
                .append(degrees(fix.longitude()))
                .append(',')
                .append(degrees(fix.latitude()))
                .append("]},\"metadata\":{}},\"Status\":{\"type\":\"Boolean\",\"value\":true,\"metadata\":{}}")
                .append(",\"Battery\":{\"type\":\"Float\",\"value\":0.87,\"metadata\":{}}")
                .append(",\"Time\":{\"type\":\"Integer\",\"value\":")
                .append(time)
                .append(",\"metadata\":{}}");
        if (characters > 0) {
            json.append(",\"Notes\":{\"type\":\"Text\",\"value\":\"")
                    .append("x".repeat(characters))
                    .append("\",\"metadata\":{}}");
        }
        ProducerRecord<byte[], byte[]> record = new ProducerRecord<>(
                topic, partition, time, ascii(fix.id()), ascii(json.append('}').toString()));
        record.headers().add(HeaderNames.SERVICE, SERVICE).add(HeaderNames.SERVICE_PATH, SERVICE_PATH);
        return record;
    }

    /** With seven decimals, a centimeter, like receivers. */
    private static String degrees(double degrees) {
        return BigDecimal.valueOf(Math.round(degrees * 1e7), 7).toPlainString();
    }

    private static byte[] ascii(String text) {
        return text.getBytes(StandardCharsets.US_ASCII);
    }
}
