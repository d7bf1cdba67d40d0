package io.furrow.simulators.camera;

import java.awt.image.BufferedImage;
import java.io.ByteArrayInputStream;
import java.io.IOException;
import java.time.Instant;
import java.util.Arrays;
import java.util.List;
import javax.imageio.ImageIO;

import org.junit.jupiter.api.Test;

import io.furrow.model.position.Position;

import static org.assertj.core.api.Assertions.assertThat;

class FieldPictureTest {
    private static final Position PLACE = new Position(40.3, -3.48);
    private static final Instant TIME = Instant.parse("2026-06-01T12:00:00Z");

    @Test
    void isAPngOfItsSize() throws IOException {
        byte[] png = FieldPicture.png(view(List.of()));

        assertThat(png).startsWith(0x89, 'P', 'N', 'G').hasSizeBetween(1_000, 40_000);
        BufferedImage image = ImageIO.read(new ByteArrayInputStream(png));
        assertThat(image.getWidth()).isEqualTo(FieldPicture.WIDTH);
        assertThat(image.getHeight()).isEqualTo(FieldPicture.HEIGHT);
    }

    @Test
    void isTheSameForTheSameViewAndChangesWithTime() {
        assertThat(FieldPicture.png(view(List.of(north(20))))).isEqualTo(FieldPicture.png(view(List.of(north(20)))));
        assertThat(FieldPicture.png(new CameraView(TIME.plusSeconds(1), PLACE, 0, List.of())))
                .isNotEqualTo(FieldPicture.png(view(List.of())));
    }

    @Test
    void seesTheFarthestFirstAndNothingBehindItOrOutOfSight() {
        CameraView view = view(List.of(north(20), north(40), north(-20), north(70)));

        assertThat(view.visibleRobots())
                .extracting(seen -> Math.round(seen.meters()))
                .containsExactly(40L, 20L);
    }

    /** Right of the middle when it is to the east of a camera that looks north; larger when it is nearer. */
    @Test
    void drawsWhatIsInSightWhereItIs() throws IOException {
        Position east = new Position(PLACE.latitude() + 20 / 111_194.9, PLACE.longitude() + 0.00008);
        int[] far = red(List.of(east));
        int[] near = red(List.of(north(10)));

        assertThat(far).isNotEmpty();
        assertThat(Arrays.stream(far)).allMatch(x -> x > FieldPicture.WIDTH / 2);
        assertThat(near.length).isGreaterThan(2 * far.length);
        assertThat(red(List.of())).isEmpty();
        assertThat(red(List.of(north(-10)))).isEmpty();
    }

    /** The columns of all pixels in the color of robots. */
    private static int[] red(List<Position> robots) throws IOException {
        BufferedImage image = image(FieldPicture.png(view(robots)));
        int[] columns = new int[FieldPicture.WIDTH * FieldPicture.HEIGHT];
        int count = 0;
        for (int x = 0; x < FieldPicture.WIDTH; x++) {
            for (int y = 0; y < FieldPicture.HEIGHT; y++) {
                if ((image.getRGB(x, y) & 0xFFFFFF) == 0xC0392B) {
                    columns[count++] = x;
                }
            }
        }
        return Arrays.copyOf(columns, count);
    }

    private static CameraView view(List<Position> robots) {
        return new CameraView(TIME, PLACE, 0, robots);
    }

    private static Position north(double meters) {
        return new Position(PLACE.latitude() + meters / 111_194.9, PLACE.longitude());
    }

    private static BufferedImage image(byte[] png) throws IOException {
        return ImageIO.read(new ByteArrayInputStream(png));
    }
}
