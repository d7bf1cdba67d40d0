package io.furrow.model.control;

import org.junit.jupiter.api.Test;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class MissionTemplateTest {
    private static final String EXPORTED = """
            {"template":"scouting","version":3,"description":"Two robots","devices":[{"name":"robot","type":"Robot","count":2,\
            "period":"PT0.5S","path":[[-3.48,40.31],[-3.47,40.31]],"speed":1.5},{"type":"Camera","count":2,"carriedBy":"robot",\
            "faults":[{"kind":"silent","after":"PT5M"}]},"urn:ngsi-ld:AgriRobot:7"]}""";

    @Test
    void readsBackAnExportedTemplate() throws Exception {
        MissionTemplate template = MissionTemplate.read(EXPORTED.getBytes(UTF_8));

        assertThat(template.key()).isEqualTo("scouting@3");
        assertThat(template.devices().count()).isEqualTo(5);
        assertThat(new String(template.toBytes(), UTF_8)).isEqualTo(EXPORTED);
        assertThat(MissionTemplate.read(template.toBytes())).isEqualTo(template);
    }

    @Test
    void reportsWhatIsWrongWithAFile() {
        assertThatThrownBy(() -> MissionTemplate.read("{\"template\":\"a b\"}".getBytes(UTF_8)))
                .isInstanceOf(RejectedException.class)
                .hasMessageContaining("'a b' is not a name for 'template'");
        assertThatThrownBy(() -> MissionTemplate.read("nonsense".getBytes(UTF_8)))
                .isInstanceOfSatisfying(
                        RejectedException.class, e -> assertThat(e.code()).isEqualTo(ErrorCode.NOT_JSON));
    }
}
