package io.furrow.mission.mongo;

import java.util.Map;
import java.util.TreeMap;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.bson.BsonDocument;
import org.bson.BsonType;
import org.bson.RawBsonDocument;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.mission.StoredEvent;
import io.furrow.model.ngsi.NgsiJson;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class EventDocumentCodecTest {
    private static final long TIME = 1_700_000_000_000L;

    private static final Map<String, String> HEADERS = new TreeMap<>(Map.of(
            "origin", "notification", "ts-device", "1700000000000", "ts-source", "1700000000007", "ts-x", "007"));

    @Test
    void keepsTheEntityAsReportedWithIdTimeAndStamps() throws Exception {
        BsonDocument document = written(
                "{\"id\":\"t1\",\"type\":\"Thermometer\",\"Temperature\":{\"type\":\"Float\",\"value\":21.5,\"metadata\":{}}}");

        assertThat(document.toJson()).isEqualTo("""
                {"_id": "e1", "id": "t1", "type": "Thermometer", \
                "Temperature": {"type": "Float", "value": 21.5, "metadata": {}}, \
                "_time": {"$date": "2023-11-14T22:13:20Z"}, \
                "_headers": {"origin": "notification", "ts-device": 1700000000000, "ts-source": 1700000000007, \
                "ts-x": "007"}}""");
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
                    0                                       | INT32
                    -1                                      | INT32
                    2147483648                              | INT64
                    1700000000000                           | INT64
                    9223372036854775808                     | DECIMAL128
                    21.5                                    | DOUBLE
                    21.0                                    | DOUBLE
                    0.1                                     | DOUBLE
                    -0.007                                  | DOUBLE
                    40.313812345678                         | DOUBLE
                    21.50                                   | DECIMAL128
                    1E+3                                    | DECIMAL128
                    1E-400                                  | DECIMAL128
                    0.1234567890123456789012345678901234    | DECIMAL128
                    1234567890123456789012345678901234      | DECIMAL128
                    """)
    void keepsANumberDigitForDigit(String number, BsonType type) throws Exception {
        BsonDocument document = written("{\"id\":\"t1\",\"n\":{\"value\":" + number + "}}");

        assertThat(document.getDocument("n").get("value").getBsonType()).isEqualTo(type);
        assertThat(json(EventDocumentCodec.read(document))).contains("\"value\":" + number + "}");
    }

    @Test
    void readsBackTheSameEvent() throws Exception {
        String json = """
                {"id":"t1","type":"T","a.b":{"$in":[1,2.50,null,true,{"x.y":"\\u0000\\n°"},[],{}],"":{"%":1}},"_time":{"value":3},\
                "_id":{"value":"mine"},"$where":{"value":"1"}}""";

        StoredEvent read = EventDocumentCodec.read(written(json));

        assertThat(json(read)).isEqualTo(NgsiJson.read(json.getBytes(UTF_8)).toString());
        assertThat(read).isEqualTo(event(json));
    }

    @Test
    void keepsADeletion() throws Exception {
        StoredEvent deletion = new StoredEvent("e1", TIME, "t1", HEADERS, null);

        assertThat(EventDocumentCodec.read(new RawBsonDocument(EventDocumentCodec.write(deletion))))
                .isEqualTo(deletion);
    }

    private static BsonDocument written(String json) throws Exception {
        return new RawBsonDocument(EventDocumentCodec.write(event(json)));
    }

    private static StoredEvent event(String json) throws Exception {
        JsonNode entity = NgsiJson.read(json.getBytes(UTF_8));
        return new StoredEvent("e1", TIME, "t1", HEADERS, (ObjectNode) entity);
    }

    private static String json(StoredEvent event) {
        return new String(NgsiJson.write(event.entity()), UTF_8);
    }
}
