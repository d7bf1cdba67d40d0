package io.furrow.control.health;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

/** The dashboard's page is tested with the same table. */
class BatteryTest {
    private static final Path TABLE = Path.of("../../kit/model/src/test/resources/io/furrow/model/ngsi/batteries.csv");

    static List<String> cases() throws Exception {
        return Files.readAllLines(TABLE).stream()
                .filter(line -> !line.startsWith("#"))
                .toList();
    }

    @ParameterizedTest
    @MethodSource("cases")
    void followsTheCaseTable(String line) throws Exception {
        String[] columns = line.split(" \\| ");
        boolean percent = columns.length > 2;
        Double level = null;
        for (JsonNode report : NgsiJson.mapper().readTree(columns[0])) {
            Entity entity = Entity.of(((ObjectNode) report).put("id", "a"));
            percent |= Battery.isPercent(entity);
            level = Battery.levelOf(entity, percent);
        }

        if (columns[1].equals("none")) {
            assertThat(level).isNull();
        } else {
            assertThat(level).isEqualTo(Double.parseDouble(columns[1]), within(1e-9));
        }
    }
}
