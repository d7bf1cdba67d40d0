package io.furrow.simulators.device;

import java.time.Instant;
import java.util.Base64;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.TextNode;

import io.furrow.model.ngsi.Position;
import io.furrow.simulators.camera.FieldPicture;
import io.furrow.simulators.camera.View;

/** Takes a PNG of its field, base64 in member {@code img}, that shows which camera took it, when and where. */
record Camera(String name) implements Sensor {
    @Override
    public String entityType() {
        return "Camera";
    }

    /** Of type TextUnrestricted because the context broker refuses the {@code =} of base64 in ordinary text. */
    @Override
    public Registration.Attribute attribute() {
        return new Registration.Attribute("img", "Image", "TextUnrestricted");
    }

    @Override
    public JsonNode measure(Instant time, Position place) {
        return TextNode.valueOf(
                Base64.getEncoder().encodeToString(FieldPicture.png(new View(name, time, place, 0, "", List.of()))));
    }
}
