package io.furrow.bench.analytics.load;

import java.nio.charset.StandardCharsets;
import java.util.Arrays;

import org.apache.kafka.clients.producer.ProducerRecord;

import io.furrow.analytics.position.PositionFix;
import io.furrow.model.event.HeaderNames;

/** A fix as the entity of a robot in the form in which the NGSI source writes it. */
final class RobotJson {
    private static final byte[] SERVICE = ascii("farm");
    private static final byte[] SERVICE_PATH = ascii("/");

    private static final byte[] HEAD = ascii("{\"id\":\"");
    private static final byte[] LOCATION = ascii("\",\"type\":\"Robot\",\"location\":{\"type\":\"geo:json\",\"value\":{"
            + "\"type\":\"Point\",\"coordinates\":[");
    private static final byte[] OTHERS = ascii("]},\"metadata\":{}},"
            + "\"Status\":{\"type\":\"Boolean\",\"value\":true,\"metadata\":{}},"
            + "\"Battery\":{\"type\":\"Float\",\"value\":0.87,\"metadata\":{}},"
            + "\"Time\":{\"type\":\"Integer\",\"value\":");
    private static final byte[] TAIL = ascii(",\"metadata\":{}}}");

    private static final String NOTES = ",\"Notes\":{\"type\":\"Text\",\"value\":\"%s\",\"metadata\":{}}}";

    private static final int TIME_DIGITS = 13;
    /** A sign and three digits. */
    private static final int WHOLE_WIDTH = 4;

    private static final int DECIMAL_DIGITS = 7;
    private static final long DECIMALS = 10_000_000;
    private static final int LENGTH = HEAD.length
            + LOCATION.length
            + 2 * (WHOLE_WIDTH + 1 + DECIMAL_DIGITS)
            + 1
            + OTHERS.length
            + TIME_DIGITS
            + TAIL.length;

    private RobotJson() {}

    /** @param time of the record, epoch milliseconds */
    static ProducerRecord<byte[], byte[]> record(String topic, PositionFix fix, long time) {
        byte[] id = ascii(fix.id());
        ProducerRecord<byte[], byte[]> record = new ProducerRecord<>(topic, null, time, id, bytes(id, fix, time));
        record.headers().add(HeaderNames.SERVICE, SERVICE).add(HeaderNames.SERVICE_PATH, SERVICE_PATH);
        return record;
    }

    /** The same with an attribute {@code Notes} of as many characters, on a partition. */
    static ProducerRecord<byte[], byte[]> padded(
            String topic, int partition, PositionFix fix, long time, int characters) {
        ProducerRecord<byte[], byte[]> plain = record(topic, fix, time);
        byte[] value = plain.value();
        if (characters > 0) {
            byte[] notes = ascii(NOTES.formatted("x".repeat(characters)));
            value = Arrays.copyOf(value, value.length - 1 + notes.length); // the last brace is that of the notes
            System.arraycopy(notes, 0, value, value.length - notes.length, notes.length);
        }
        return new ProducerRecord<>(topic, partition, time, plain.key(), value, plain.headers());
    }

    private static byte[] bytes(byte[] id, PositionFix fix, long time) {
        byte[] json = Arrays.copyOf(HEAD, LENGTH + id.length);
        int at = put(id, json, HEAD.length);
        at = put(LOCATION, json, at);
        at = putDegrees(fix.longitude(), json, at);
        json[at++] = ',';
        at = putDegrees(fix.latitude(), json, at);
        at = put(OTHERS, json, at);
        at = putDigits(time, TIME_DIGITS, json, at);
        put(TAIL, json, at);
        return json;
    }

    private static int put(byte[] part, byte[] json, int at) {
        System.arraycopy(part, 0, json, at, part.length);
        return at + part.length;
    }

    /** With seven decimals, a centimeter, as receivers report them, and as much white space as makes all equally long. */
    private static int putDegrees(double degrees, byte[] json, int at) {
        long units = Math.round(Math.abs(degrees) * DECIMALS);
        int point = at + WHOLE_WIDTH;
        int first = point;
        for (long rest = units / DECIMALS; rest > 0 || first == point; rest /= 10) {
            json[--first] = (byte) ('0' + rest % 10);
        }
        if (degrees < 0) {
            json[--first] = '-';
        }
        Arrays.fill(json, at, first, (byte) ' ');
        json[point] = '.';
        return putDigits(units % DECIMALS, DECIMAL_DIGITS, json, point + 1);
    }

    private static int putDigits(long number, int digits, byte[] json, int at) {
        long rest = number;
        for (int i = at + digits - 1; i >= at; i--) {
            json[i] = (byte) ('0' + rest % 10);
            rest /= 10;
        }
        return at + digits;
    }

    private static byte[] ascii(String text) {
        return text.getBytes(StandardCharsets.US_ASCII);
    }
}
