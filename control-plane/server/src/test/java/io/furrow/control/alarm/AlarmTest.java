package io.furrow.control.alarm;

import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.StateJson;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class AlarmTest {

    @Test
    void readsAnAlarmWithoutOptionalMembers() {
        Alarm read = StateJson.read("""
                {"alarm":"silent-device-1","kind":"silent-device","subject":"urn:t:1","severity":"minor","state":"open",                "change":"opened","text":"it is silent","devices":[{"id":"urn:t:1","type":"Thermometer"}],                "raised":1700000000000,"changed":1700000000000,"count":1,"sequence":1}""".getBytes(UTF_8), Alarm.class);
        assertThat(read)
                .returns(null, alarm -> alarm.extent().affected())
                .returns(null, Alarm::group)
                .returns(null, Alarm::seen)
                .returns(null, Alarm::inhibitedBy);
        assertThat(read.toBytes()).asString().doesNotContain("null", "affected");
    }
}
