package io.furrow.ingest.image;

import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Set;

import com.fasterxml.jackson.core.JsonParser;
import com.fasterxml.jackson.core.JsonToken;

import io.furrow.model.ngsi.JsonProblem;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/**
 * The position of an image attribute's text in the bytes of an entity, so that it can be replaced without changing any other
 * byte.
 *
 * @param from position of the opening quote
 * @param to position after the closing quote
 * @param escaped whether the text has JSON escapes
 */
record ImageRange(String attribute, int from, int to, boolean escaped) {
    /** Whether an entity need be parsed: its bytes contain one of the names, or an escape that could be part of one. */
    static boolean possible(byte[] entity, List<byte[]> quotedNames) {
        for (int i = 0; i < entity.length; i++) {
            if (entity[i] == '\\' && i + 1 < entity.length && entity[i + 1] == 'u') {
                return true;
            }
            if (entity[i] == '"') {
                for (byte[] name : quotedNames) {
                    if (i + name.length <= entity.length
                            && Arrays.equals(entity, i, i + name.length, name, 0, name.length)) {
                        return true;
                    }
                }
            }
        }
        return false;
    }

    /** The names as JSON, for {@link #possible}. */
    static List<byte[]> quoted(Set<String> attributes) {
        return attributes.stream()
                .map(name -> ('"' + name + '"').getBytes(StandardCharsets.UTF_8))
                .toList();
    }

    /**
     * The attributes of these names with a text as value, in the order of the entity; blank texts and addresses
     * ({@code …://…}) are not images.
     */
    static List<ImageRange> find(byte[] entity, Set<String> attributes) throws UnreadableException {
        List<ImageRange> spans = new ArrayList<>();
        try (JsonParser parser = NgsiJson.mapper().createParser(entity)) {
            parser.nextToken();
            while (parser.nextToken() == JsonToken.FIELD_NAME) {
                String name = parser.currentName();
                boolean object = parser.nextToken() == JsonToken.START_OBJECT;
                if (object && attributes.contains(name)) {
                    readAttribute(parser, entity, name, spans);
                } else {
                    parser.skipChildren();
                }
            }
            return spans;
        } catch (IOException e) {
            throw new UnreadableException(Reason.NOT_JSON, JsonProblem.of(e), e);
        }
    }

    private static void readAttribute(JsonParser parser, byte[] entity, String name, List<ImageRange> spans)
            throws IOException, UnreadableException {
        while (parser.nextToken() == JsonToken.FIELD_NAME) {
            boolean value = parser.currentName().equals("value");
            if (parser.nextToken() == JsonToken.VALUE_STRING && value) {
                ImageRange span =
                        at(entity, name, (int) parser.currentTokenLocation().getByteOffset());
                if (span.holdsImage(entity)) {
                    spans.add(span);
                }
            } else {
                parser.skipChildren();
            }
        }
    }

    private static ImageRange at(byte[] entity, String name, int quote) throws UnreadableException {
        boolean escaped = false;
        int i = quote + 1;
        for (; i < entity.length && entity[i] != '"'; i++) {
            if (entity[i] == '\\') {
                escaped = true;
                i++;
            }
        }
        if (i >= entity.length) {
            throw new UnreadableException(Reason.NOT_JSON, "a text has no end");
        }
        return new ImageRange(name, quote, i + 1, escaped);
    }

    /** The text, decoded from JSON. */
    byte[] text(byte[] entity) throws UnreadableException {
        return escaped
                ? NgsiJson.read(Arrays.copyOfRange(entity, from, to))
                        .textValue()
                        .getBytes(StandardCharsets.UTF_8)
                : Arrays.copyOfRange(entity, from + 1, to - 1);
    }

    private boolean holdsImage(byte[] entity) throws UnreadableException {
        byte[] start = to - from > MAX_ADDRESS_LENGTH ? Arrays.copyOfRange(entity, from + 1, from + 20) : text(entity);
        String text = new String(start, StandardCharsets.UTF_8);
        return !text.isBlank() && !text.matches("(?s)[A-Za-z][A-Za-z0-9+.-]*:/.*");
    }

    /** The entity with each text replaced. */
    static byte[] replace(byte[] entity, List<ImageRange> spans, List<byte[]> values) {
        ByteArrayOutputStream replaced = new ByteArrayOutputStream();
        int kept = 0;
        for (int i = 0; i < spans.size(); i++) {
            replaced.write(entity, kept, spans.get(i).from() - kept);
            replaced.writeBytes(values.get(i));
            kept = spans.get(i).to();
        }
        replaced.write(entity, kept, entity.length - kept);
        return replaced.toByteArray();
    }

    /** A longer text is an image or a broken one, never blank or an address. */
    private static final int MAX_ADDRESS_LENGTH = 4096;
}
