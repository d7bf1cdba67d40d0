package io.furrow.connect.sink;

import java.math.BigDecimal;
import java.time.Instant;
import java.util.Arrays;
import java.util.Date;
import java.util.List;
import java.util.Map;

import org.apache.kafka.connect.data.Decimal;
import org.apache.kafka.connect.data.Schema;
import org.apache.kafka.connect.data.SchemaBuilder;
import org.apache.kafka.connect.data.Struct;
import org.apache.kafka.connect.data.Time;
import org.apache.kafka.connect.data.Timestamp;
import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class StructReaderTest {
    @Test
    void makesAnAttributeOfEachFieldThatIsNotNull() throws Exception {
        Schema place = SchemaBuilder.struct()
                .field("street", Schema.STRING_SCHEMA)
                .field("number", Schema.OPTIONAL_INT32_SCHEMA)
                .optional()
                .build();
        Schema schema = SchemaBuilder.struct()
                .name("org.example.Barn")
                .field("id", Schema.STRING_SCHEMA)
                .field("open", Schema.BOOLEAN_SCHEMA)
                .field("cows", Schema.INT64_SCHEMA)
                .field("weight", Schema.FLOAT32_SCHEMA)
                .field("price", Decimal.schema(2))
                .field("built", org.apache.kafka.connect.data.Date.SCHEMA)
                .field("milked", Timestamp.SCHEMA)
                .field("opens", Time.SCHEMA)
                .field("mark", Schema.BYTES_SCHEMA)
                .field("place", place)
                .field(
                        "stalls",
                        SchemaBuilder.array(Schema.OPTIONAL_INT32_SCHEMA).build())
                .field(
                        "doors",
                        SchemaBuilder.map(Schema.STRING_SCHEMA, Timestamp.SCHEMA)
                                .build())
                .field("owner", Schema.OPTIONAL_STRING_SCHEMA)
                .build();
        Struct barn = new Struct(schema)
                .put("id", "barn1")
                .put("open", true)
                .put("cows", 9_007_199_254_740_993L)
                .put("weight", 0.1f)
                .put("price", new BigDecimal("12.50"))
                .put("built", new Date(86_400_000L))
                .put("milked", Date.from(Instant.parse("2026-05-01T04:05:06.007Z")))
                .put("opens", new Date(3_600_000L))
                .put("mark", new byte[] {1, 2, 3})
                .put("place", new Struct(place).put("street", "Rye Lane"))
                .put("stalls", Arrays.asList(1, null, 3))
                .put("doors", Map.of("north", new Date(0)));

        Entity entity = Entity.ofAnyForm(StructReader.entity(barn));

        assertThat(NgsiJson.read(entity.toBytes())).isEqualTo(NgsiJson.mapper().readTree("""
                {"open": {"type": "Boolean", "value": true, "metadata": {}},
                 "id": "barn1", "type": "Barn",
                 "cows": {"type": "Number", "value": 9007199254740993, "metadata": {}},
                 "weight": {"type": "Number", "value": 0.1, "metadata": {}},
                 "price": {"type": "Number", "value": 12.50, "metadata": {}},
                 "built": {"type": "DateTime", "value": "1970-01-02", "metadata": {}},
                 "milked": {"type": "DateTime", "value": "2026-05-01T04:05:06.007Z", "metadata": {}},
                 "opens": {"type": "Text", "value": "01:00", "metadata": {}},
                 "mark": {"type": "Text", "value": "AQID", "metadata": {}},
                 "place": {"type": "StructuredValue", "value": {"street": "Rye Lane"}, "metadata": {}},
                 "stalls": {"type": "StructuredValue", "value": [1, null, 3], "metadata": {}},
                 "doors": {"type": "StructuredValue", "value": {"north": "1970-01-01T00:00:00Z"}, "metadata": {}}}"""));
    }

    @Test
    void takesAStructOfValueTypeAndMetadataForTheAttributeItIs() throws Exception {
        Schema unit =
                SchemaBuilder.struct().field("value", Schema.STRING_SCHEMA).build();
        Schema metadata = SchemaBuilder.struct().field("unitCode", unit).build();
        Schema attribute = SchemaBuilder.struct()
                .field("type", Schema.STRING_SCHEMA)
                .field("value", Schema.FLOAT64_SCHEMA)
                .field("metadata", metadata)
                .build();
        Schema schema = SchemaBuilder.struct()
                .field("id", Schema.STRING_SCHEMA)
                .field("type", Schema.STRING_SCHEMA)
                .field("temperature", attribute)
                .build();
        Struct room = new Struct(schema)
                .put("id", "r")
                .put("type", "Room")
                .put(
                        "temperature",
                        new Struct(attribute)
                                .put("type", "Float")
                                .put("value", 21.5)
                                .put(
                                        "metadata",
                                        new Struct(metadata).put("unitCode", new Struct(unit).put("value", "CEL"))));

        assertThat(StructReader.entity(room)).hasToString("""
                {"id":"r","type":"Room","temperature":{"type":"Float","value":21.5,\
                "metadata":{"unitCode":{"type":"Text","value":"CEL"}}}}""");
    }

    @Test
    void refusesANumberThatJsonHasNot() {
        Schema schema = SchemaBuilder.struct()
                .field("id", Schema.STRING_SCHEMA)
                .field("x", Schema.FLOAT64_SCHEMA)
                .build();

        for (double odd : List.of(Double.NaN, Double.POSITIVE_INFINITY)) {
            assertThatThrownBy(() -> StructReader.entity(
                            new Struct(schema).put("id", "a").put("x", odd)))
                    .isInstanceOf(UnreadableException.class)
                    .hasMessageContaining(String.valueOf(odd));
        }
    }
}
