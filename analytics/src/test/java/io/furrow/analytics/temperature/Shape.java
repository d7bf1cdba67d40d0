package io.furrow.analytics.temperature;

import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.stream.Collectors;
import java.util.stream.Stream;

/**
 * The area of a field in a random case: one or two parts, some slanted, some with a hole. All corners are on whole or half
 * degrees, so that arithmetic on them is exact, and this says without JTS what is covered.
 *
 * @param parts each a border, and maybe a hole
 */
record Shape(List<List<Ring>> parts) {
    /** Corners as longitude, latitude; the first is not repeated. */
    record Ring(double[]... corners) {
        boolean hasOnBorder(double x, double y) {
            for (int i = 0; i < corners.length; i++) {
                double[] a = corners[i];
                double[] b = corners[(i + 1) % corners.length];
                boolean inLine = (b[0] - a[0]) * (y - a[1]) == (b[1] - a[1]) * (x - a[0]);
                boolean between = Math.min(a[0], b[0]) <= x
                        && x <= Math.max(a[0], b[0])
                        && Math.min(a[1], b[1]) <= y
                        && y <= Math.max(a[1], b[1]);
                if (inLine && between) {
                    return true;
                }
            }
            return false;
        }

        /** By the sum of the angles under which the edges are seen. */
        boolean hasInside(double x, double y) {
            double turned = 0;
            for (int i = 0; i < corners.length; i++) {
                double[] a = corners[i];
                double[] b = corners[(i + 1) % corners.length];
                double angle = Math.atan2(b[1] - y, b[0] - x) - Math.atan2(a[1] - y, a[0] - x);
                turned += Math.atan2(Math.sin(angle), Math.cos(angle));
            }
            return Math.abs(turned) > Math.PI;
        }

        private String geoJson() {
            return Stream.concat(Stream.of(corners), Stream.of(corners[0]))
                    .map(corner -> "[" + corner[0] + "," + corner[1] + "]")
                    .collect(Collectors.joining(",", "[", "]"));
        }
    }

    static Shape of(Random random) {
        List<List<Ring>> parts = new ArrayList<>();
        int west = random.nextInt(3);
        parts.add(part(random, west));
        if (random.nextInt(3) == 0) {
            parts.add(part(random, west + 4));
        }
        return new Shape(parts);
    }

    /** At most three degrees wide. */
    private static List<Ring> part(Random random, int west) {
        int south = 1 + random.nextInt(3);
        int east = west + 2 + random.nextInt(2);
        int north = south + 2 + random.nextInt(3);
        double[][] box = {{west, south}, {east, south}, {east, north}, {west, north}};
        return switch (random.nextInt(4)) {
            case 0 -> List.of(new Ring(box[0], box[1], box[3]));
            case 1 ->
                List.of(new Ring(
                        box[0], box[1], new double[] {east, south + 1}, new double[] {west + 1, south + 1}, box[3]));
            case 2 ->
                List.of(
                        new Ring(box),
                        new Ring(
                                new double[] {west + 0.5, south + 0.5},
                                new double[] {west + 1.5, south + 0.5},
                                new double[] {west + 1.5, south + 1.5},
                                new double[] {west + 0.5, south + 1.5}));
            default -> List.of(new Ring(box));
        };
    }

    Shape movedEast(double degrees) {
        return new Shape(parts.stream()
                .map(part -> part.stream()
                        .map(ring -> new Ring(Stream.of(ring.corners())
                                .map(corner -> new double[] {corner[0] + degrees, corner[1]})
                                .toArray(double[][]::new)))
                        .toList())
                .toList());
    }

    boolean covers(double longitude, double latitude) {
        return parts.stream().anyMatch(part -> {
            if (part.stream().anyMatch(ring -> ring.hasOnBorder(longitude, latitude))) {
                return true;
            }
            boolean inHole = part.stream().skip(1).anyMatch(hole -> hole.hasInside(longitude, latitude));
            return part.get(0).hasInside(longitude, latitude) && !inHole;
        });
    }

    /** Coordinates of a MultiPolygon. */
    String coordinates() {
        return parts.stream()
                .map(part -> part.stream().map(Ring::geoJson).collect(Collectors.joining(",", "[", "]")))
                .collect(Collectors.joining(",", "[", "]"));
    }
}
