package io.furrow.flink.record;

import java.nio.charset.StandardCharsets;
import java.util.AbstractMap;
import java.util.AbstractSet;
import java.util.Arrays;
import java.util.Iterator;
import java.util.List;
import java.util.Map;
import java.util.Set;

import org.apache.kafka.common.header.Header;
import org.apache.kafka.common.header.internals.RecordHeader;

/**
 * The headers of a Kafka record as an unmodifiable map of texts by name. They stay bytes until one is read, because most
 * headers pass through a job unread.
 */
public final class TextHeaders extends AbstractMap<String, String> {
    public static final TextHeaders NONE = new TextHeaders(new Header[0]);

    private static final byte[] EMPTY = {};

    private final Header[] headers;

    private TextHeaders(Header[] headers) {
        this.headers = headers;
    }

    /** Of a repeated header the last; one without a value has an empty text. */
    public static TextHeaders of(Header[] received) {
        Header[] kept = new Header[received.length];
        int count = 0;
        for (Header header : received) {
            int before = indexOf(header.key(), kept, count);
            kept[before < 0 ? count++ : before] =
                    header.value() == null ? new RecordHeader(header.key(), EMPTY) : header;
        }
        return new TextHeaders(count == kept.length ? kept : Arrays.copyOf(kept, count));
    }

    public static TextHeaders of(Map<String, String> texts) {
        return texts instanceof TextHeaders same ? same : NONE.with(texts);
    }

    /** The same with further headers, which replace those of the same name. */
    TextHeaders with(Map<String, String> more) {
        Header[] all = Arrays.copyOf(headers, headers.length + more.size());
        int count = headers.length;
        for (Map.Entry<String, String> one : more.entrySet()) {
            int before = indexOf(one.getKey(), all, count);
            all[before < 0 ? count++ : before] =
                    new RecordHeader(one.getKey(), one.getValue().getBytes(StandardCharsets.UTF_8));
        }
        return new TextHeaders(count == all.length ? all : Arrays.copyOf(all, count));
    }

    /** The same with further headers. @param more with values, and with distinct new names; not checked */
    public TextHeaders plus(Header... more) {
        Header[] all = Arrays.copyOf(headers, headers.length + more.length);
        System.arraycopy(more, 0, all, headers.length, more.length);
        return new TextHeaders(all);
    }

    public List<Header> bytes() {
        return Arrays.asList(headers);
    }

    @Override
    public String get(Object name) {
        int at = indexOf(name, headers, headers.length);
        return at < 0 ? null : text(headers[at]);
    }

    @Override
    public boolean containsKey(Object name) {
        return indexOf(name, headers, headers.length) >= 0;
    }

    @Override
    public int size() {
        return headers.length;
    }

    private static int indexOf(Object name, Header[] headers, int count) {
        for (int i = 0; i < count; i++) {
            if (headers[i].key().equals(name)) {
                return i;
            }
        }
        return -1;
    }

    private static String text(Header header) {
        return new String(header.value(), StandardCharsets.UTF_8);
    }

    @Override
    public Set<Map.Entry<String, String>> entrySet() {
        return new AbstractSet<>() {
            @Override
            public Iterator<Map.Entry<String, String>> iterator() {
                return bytes().stream()
                        .map(header -> Map.entry(header.key(), text(header)))
                        .iterator();
            }

            @Override
            public int size() {
                return headers.length;
            }
        };
    }
}
