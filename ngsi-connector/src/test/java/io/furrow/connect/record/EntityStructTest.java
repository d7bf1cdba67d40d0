package io.furrow.connect.record;

import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;
import io.apicurio.registry.utils.converter.avro.AvroData;
import org.apache.avro.generic.GenericRecord;
import org.apache.kafka.connect.data.SchemaAndValue;
import org.apache.kafka.connect.data.Struct;
import org.apache.kafka.connect.json.JsonConverter;
import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;

import static org.assertj.core.api.Assertions.assertThat;

class EntityStructTest {
    private static final String THERMOMETER = """
            {"id": "urn:ngsi-ld:Thermometer:1", "type": "Thermometer",
             "Temperature": {"type": "Number", "value": 21.50, "metadata": {"unitCode": {"type": "Text", "value": "CEL"}}},
             "serial": {"type": "Number", "value": 9007199254740993, "metadata": {}},
             "name of it": {"type": "Text", "value": "größer \\"1\\"", "metadata": {}},
             "on": {"type": "Boolean", "value": true, "metadata": {}},
             "none": {"type": "None", "value": null, "metadata": {}},
             "location": {"type": "geo:json", "value": {"type": "Point", "coordinates": [1.0, 2]}, "metadata": {}}}""";

    private final JsonNode normalized;
    private final Struct struct;

    EntityStructTest() throws Exception {
        normalized = NgsiJson.mapper().readTree(THERMOMETER);
        struct = EntityStruct.of(Entity.of(normalized));
    }

    @Test
    void holdsTypedValuesBesideTheJsonOfEach() {
        assertThat(struct.getString("id")).isEqualTo("urn:ngsi-ld:Thermometer:1");
        assertThat(struct.getString("type")).isEqualTo("Thermometer");
        assertThat(attribute("Temperature").getFloat64("numberValue")).isEqualTo(21.5);
        assertThat(attribute("Temperature").getString("value")).isEqualTo("21.50");
        assertThat(attribute("serial").getString("value")).isEqualTo("9007199254740993");
        assertThat(attribute("name of it").getString("textValue")).isEqualTo("größer \"1\"");
        assertThat(attribute("on").getBoolean("booleanValue")).isTrue();
        assertThat(attribute("none").getString("value")).isEqualTo("null");
        assertThat(attribute("location").getString("value")).isEqualTo("{\"type\":\"Point\",\"coordinates\":[1.0,2]}");
        assertThat(attribute("location").getString("textValue")).isNull();
    }

    @Test
    void isTheSameEntityAgain() throws Exception {
        assertThat(EntityStruct.json(struct)).isEqualTo(normalized);
    }

    @Test
    void passesJsonWithItsSchema() throws Exception {
        JsonConverter converter = new JsonConverter();
        converter.configure(Map.of("schemas.enable", "true"), false);

        byte[] written = converter.fromConnectData("t", EntityStruct.ENTITY, struct);
        SchemaAndValue read = converter.toConnectData("t", written);

        assertThat(EntityStruct.isOf(read.schema())).isTrue();
        assertThat(EntityStruct.json((Struct) read.value())).isEqualTo(normalized);
    }

    @Test
    void passesAvro() throws Exception {
        AvroData avro = new AvroData(10);

        Object written = avro.fromConnectData(EntityStruct.ENTITY, struct);
        assertThat(written).isInstanceOf(GenericRecord.class);
        assertThat(((GenericRecord) written).getSchema().getFullName()).isEqualTo("io.furrow.ngsi.Entity");
        SchemaAndValue read = avro.toConnectData(((GenericRecord) written).getSchema(), written);

        assertThat(read.schema().version()).isEqualTo(1);
        assertThat(EntityStruct.json((Struct) read.value())).isEqualTo(normalized);
    }

    private Struct attribute(String name) {
        return (Struct) struct.getMap("attributes").get(name);
    }
}
