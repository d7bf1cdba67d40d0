package io.furrow.bench.http;

import java.net.InetSocketAddress;
import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;
import java.time.Instant;
import java.time.ZoneOffset;
import java.time.format.DateTimeFormatter;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Locale;
import java.util.stream.LongStream;

/**
 * A notification of one entity as Orion 4.7 sends it (normalized, with recorded headers and order of members), as the bytes of a
 * request. Its number, its entity's id and its times are overwritten in place, so that a request costs a small copy. The body has
 * exactly the given length. Entities stand in rows, some 100 m from each other.
 */
public final class NotificationRequest {
    /** The text before the number in the entity, in every format that keeps attributes normalized. */
    public static final String BEFORE_NUMBER = "\"sequence\":{\"type\":\"Number\",\"value\":";

    /** Digits of a number, which begins with 1 so that it is JSON. */
    public static final int DIGITS = 15;

    /** Smallest body. */
    public static final int MIN_BYTES = 500;

    private static final byte[] BEFORE = BEFORE_NUMBER.getBytes(StandardCharsets.US_ASCII);
    private static final int ID_DIGITS = 6;
    private static final String DATA = "\"data\":[";
    private static final String END_OF_DATA = "]}";
    private static final String ID_PREFIX = "urn:ngsi-ld:SoilProbe:";
    private static final int MAX_MEASURES = 8;
    private static final String BEFORE_PLACE = "\"coordinates\":[-3.7";
    private static final int PLACE_DIGITS = 3;
    private static final int ROW = 32;
    private static final String NO_PLACE = "0".repeat(PLACE_DIGITS);
    private static final String BETWEEN_PLACES = ",40.4";
    private static final String NO_ID = "0".repeat(ID_DIGITS);
    private static final String NO_NUMBER = "1" + "0".repeat(DIGITS - 1);
    private static final String NO_TIME = "2026-01-01T00:00:00.000Z";
    private static final DateTimeFormatter TIME = DateTimeFormatter.ofPattern(
                    "yyyy-MM-dd'T'HH:mm:ss.SSS'Z'", Locale.ROOT)
            .withZone(ZoneOffset.UTC);

    private final byte[] bytes;
    private final ByteBuffer request;
    private final int entities;
    private final int entityAt;
    private final int idAt;
    private final int longitudeAt;
    private final int latitudeAt;
    private final int numberAt;
    private final int[] timesAt;
    private long millis = -1;

    private NotificationRequest(String head, String body, int entities) {
        String text = head + body;
        this.bytes = text.getBytes(StandardCharsets.US_ASCII);
        this.request = ByteBuffer.allocateDirect(bytes.length);
        this.entities = entities;
        this.entityAt = text.indexOf(DATA) + DATA.length();
        this.idAt = text.indexOf(ID_PREFIX) + ID_PREFIX.length();
        this.longitudeAt = text.indexOf(BEFORE_PLACE) + BEFORE_PLACE.length();
        this.latitudeAt = longitudeAt + PLACE_DIGITS + BETWEEN_PLACES.length();
        this.numberAt = text.indexOf(BEFORE_NUMBER) + BEFORE_NUMBER.length();
        List<Integer> times = new ArrayList<>();
        for (int at = text.indexOf(NO_TIME); at >= 0; at = text.indexOf(NO_TIME, at + 1)) {
            times.add(at);
        }
        this.timesAt = times.stream().mapToInt(Integer::intValue).toArray();
    }

    /**
     * Creates a request.
     *
     * @param bodyBytes at least {@value #MIN_BYTES}
     * @param entities number of ids, at most a million
     */
    public static NotificationRequest to(InetSocketAddress target, int bodyBytes, int entities) {
        String body = body(bodyBytes);
        String head = String.join(
                "\r\n",
                "POST /v2/notify HTTP/1.1",
                "Host: " + target.getHostString() + ":" + target.getPort(),
                "User-Agent: orion/4.7.0-next libcurl/7.88.1",
                "Fiware-Service: farm",
                "Fiware-Servicepath: /",
                "Accept: application/json",
                "Content-Length: " + body.length(),
                "Content-Type: application/json; charset=utf-8",
                "Fiware-Correlator: 6badd98c-e548-11f1-acfe-02fc00000001; cbnotif=1",
                "Ngsiv2-AttrsFormat: normalized",
                "",
                "");
        return new NotificationRequest(head, body, entities);
    }

    /** Id of the entity with this number, below the number of ids. */
    public static String id(int number) {
        return ID_PREFIX + String.format(Locale.ROOT, "%0" + ID_DIGITS + "d", number);
    }

    /** The request with this number, valid until the next call. */
    public ByteBuffer with(long number, long epochMillis) {
        long entity = number % entities;
        digits(idAt, ID_DIGITS, entity);
        digits(longitudeAt, PLACE_DIGITS, entity % ROW);
        digits(latitudeAt, PLACE_DIGITS, entity / ROW);
        digits(numberAt + 1, DIGITS - 1, number);
        if (epochMillis != millis) {
            millis = epochMillis;
            byte[] time = TIME.format(Instant.ofEpochMilli(millis)).getBytes(StandardCharsets.US_ASCII);
            for (int at : timesAt) {
                System.arraycopy(time, 0, bytes, at, time.length);
            }
        }
        return request.clear().put(bytes).flip();
    }

    /** Only the entity of the request with this number, as in a record. */
    public byte[] entityWith(long number, long epochMillis) {
        with(number, epochMillis);
        return Arrays.copyOfRange(bytes, entityAt, bytes.length - END_OF_DATA.length());
    }

    /** The number in a record's value, or -1 if it holds none. */
    public static long numberIn(byte[] value) {
        return numbersIn(value).findFirst().orElse(-1);
    }

    /** The numbers in a text of several entities, in their order. */
    public static LongStream numbersIn(byte[] text) {
        LongStream.Builder numbers = LongStream.builder();
        for (int at = indexOf(text, 0); at >= 0; at = indexOf(text, at)) {
            at += BEFORE.length;
            if (at + DIGITS <= text.length) {
                numbers.add(number(text, at));
            }
        }
        return numbers.build();
    }

    private static long number(byte[] text, int at) {
        long number = 0;
        for (int i = at + 1; i < at + DIGITS; i++) {
            number = number * 10 + text[i] - '0';
        }
        return number;
    }

    /** Index of the next number's prefix, or -1. */
    private static int indexOf(byte[] text, int from) {
        for (int at = from; at <= text.length - BEFORE.length; at++) {
            if (text[at] == '"' && Arrays.equals(text, at, at + BEFORE.length, BEFORE, 0, BEFORE.length)) {
                return at;
            }
        }
        return -1;
    }

    private void digits(int at, int count, long number) {
        long rest = number;
        for (int i = at + count - 1; i >= at; i--) {
            bytes[i] = (byte) ('0' + rest % 10);
            rest /= 10;
        }
    }

    private static String body(int length) {
        if (length < MIN_BYTES) {
            throw new IllegalArgumentException(
                    "a body of " + length + " bytes is asked for, the least is " + MIN_BYTES);
        }
        StringBuilder body = new StringBuilder("{\"subscriptionId\":\"6b00efa61933b059d608cbc4\",\"data\":[{\"id\":")
                .append("\"" + ID_PREFIX + NO_ID + "\",\"type\":\"SoilProbe\",\"TimeInstant\":")
                .append("{\"type\":\"DateTime\",\"value\":\"" + NO_TIME + "\",\"metadata\":{}},\"location\":")
                .append("{\"type\":\"geo:json\",\"value\":{\"type\":\"Point\",")
                .append(BEFORE_PLACE + NO_PLACE + BETWEEN_PLACES + NO_PLACE + "]},\"metadata\":{}},")
                .append(BEFORE_NUMBER + NO_NUMBER + ",\"metadata\":{}},");
        String end = "\"note\":{\"type\":\"Text\",\"value\":\"\",\"metadata\":{}}}]}";
        for (int i = 0; i < MAX_MEASURES; i++) {
            String measure = measure(i);
            if (body.length() + measure.length() + end.length() <= length) {
                body.append(measure);
            }
        }
        int missing = length - body.length() - end.length();
        return body + end.replace("\"value\":\"\"", "\"value\":\"" + "x".repeat(missing) + "\"");
    }

    private static String measure(int i) {
        return "\"moisture%d\":{\"type\":\"Number\",\"value\":2%d.75,\"metadata\":{\"TimeInstant\":{\"type\":\"DateTime\",\"value\":\"%s\"}}},"
                .formatted(i, i, NO_TIME);
    }
}
