package io.furrow.simulators.scenario;

import java.io.IOException;
import java.io.InputStream;
import java.time.Instant;
import java.util.List;

import com.fasterxml.jackson.core.JsonProcessingException;

import io.furrow.model.ngsi.JsonProblem;
import io.furrow.model.ngsi.NgsiJson;

/**
 * The devices of a simulated farm, read from a scenario file:
 *
 * <pre>{@code
 * {"seed": 7, "apiKey": "secret", "fields": {"type": "FeatureCollection", "features": [...]},
 *  "missions": [{"domain": "farm", "mission": "weeding", "devices": [
 *    {"type": "Thermometer", "id": "t", "count": 4, "area": "field-1", "period": "PT1S", "meanCelsius": 18,
 *     "faults": [{"kind": "stuck", "value": 60, "numbers": [4]}]},
 *    {"type": "Robot", "id": "r", "period": "PT0.5S", "rows": {"field": "field-1", "spacing": 3}, "speed": 1.5},
 *    {"type": "Camera", "id": "c", "period": "PT5S", "carriedBy": "r"}]}]}
 * }</pre>
 *
 * @param apiKey key of the service group at the IoT Agent, first part of every MQTT topic
 * @param devices in the order of the file, no two of one id or one entity
 */
public record Farm(String apiKey, List<SimulatedDevice> devices) {
    /**
     * Reads a farm from its file; the same file and start always give the same farm.
     *
     * @param start base of {@code after} in faults
     * @throws InvalidScenarioException naming the member, the mistake and the remedy
     */
    public static Farm read(InputStream json, Instant start) throws IOException {
        try {
            return new FarmReader(start)
                    .farm(ScenarioObjectReader.of(NgsiJson.mapper().readTree(json), ""));
        } catch (JsonProcessingException e) {
            throw new InvalidScenarioException(
                    "line " + e.getLocation().getLineNr(), "is not valid JSON: " + JsonProblem.words(e), e);
        }
    }
}
