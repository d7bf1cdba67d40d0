package io.furrow.simulators.robot;

import java.util.SplittableRandom;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/** Fields of any form, many of them hollow or with a pond, each from its seed. */
final class RandomFields {
    private static final long SEED = 7_2026;
    private static final double METERS_PER_DEGREE = 111_194.9;

    private RandomFields() {}

    static Stream<ObjectNode> some(int count) {
        return new SplittableRandom(SEED).longs(count).mapToObj(RandomFields::of);
    }

    /** A star with five to sixteen corners, 15 to 60 m from its middle; every second one has a pond. */
    static ObjectNode of(long seed) {
        SplittableRandom random = new SplittableRandom(seed);
        double latitude = random.nextDouble(-60, 60);
        double longitude = random.nextDouble(-170, 170);
        int corners = random.nextInt(5, 17);
        double[] radii = random.doubles(corners, 15, 60).toArray();
        ObjectNode feature =
                JsonNodeFactory.instance.objectNode().put("type", "Feature").put("id", "field-" + seed);
        ObjectNode geometry = feature.putObject("geometry").put("type", "Polygon");
        ArrayNode rings = geometry.putArray("coordinates");
        ring(rings.addArray(), latitude, longitude, radii);
        if (random.nextBoolean()) {
            ring(rings.addArray(), latitude, longitude, random.doubles(6, 2, 8).toArray());
        }
        return feature;
    }

    private static void ring(ArrayNode ring, double latitude, double longitude, double[] radii) {
        for (int i = 0; i <= radii.length; i++) {
            double angle = 2 * Math.PI * (i % radii.length) / radii.length;
            double radius = radii[i % radii.length] / METERS_PER_DEGREE;
            ring.addArray()
                    .add(longitude + radius * Math.cos(angle) / Math.cos(Math.toRadians(latitude)))
                    .add(latitude + radius * Math.sin(angle));
        }
    }
}
