package io.furrow.ingest.image;

import org.junit.jupiter.api.Test;

import io.furrow.flink.record.DeadLetters;
import io.furrow.ingest.route.ReportedEvent;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.text.Sha256;

import static org.assertj.core.api.Assertions.assertThat;

class MoveImagesTest extends MoveImagesHarness {
    @Test
    void letsAnEventCarryAReferenceToItsImage() throws Exception {
        byte[] image = Pictures.png(1);
        ReportedEvent camera = Pictures.camera("c1", T, image);

        harness.processElement(camera, T);
        await(() -> emitted().size() == 1);

        Entity entity = Entity.parse(emitted().get(0).record().value());
        String file = "~tenant-farm/north/weeding/c1/c1_20231114221320123.png";
        assertThat(folder.resolve(file)).hasBinaryContent(image);
        assertThat(entity.value("Image").orElseThrow())
                .isEqualTo(NgsiJson.mapper()
                        .createObjectNode()
                        .put("url", "gated://" + folder + "/" + file)
                        .put("sha256", Sha256.hex(image))
                        .put("bytes", image.length)
                        .put("contentType", "image/png"));
        assertThat(emitted().get(0).record().headers())
                .isEqualTo(camera.record().headers());
        assertThat(records(harness.getSideOutput(ImageStage.MANIFEST)))
                .singleElement()
                .satisfies(manifest -> {
                    assertThat(manifest.topic()).isEqualTo("data.images");
                    assertThat(manifest.key()).asString().isEqualTo("c1");
                    assertThat(manifest.timestamp()).isEqualTo(T);
                    assertThat(NgsiJson.read(manifest.value()).toString())
                            .isEqualTo(
                                    "{\"entity\":\"c1\",\"type\":\"Camera\",\"attribute\":\"Image\",\"domain\":\"north\",\"mission\":\"weeding\","
                                            + "\"time\":\"2023-11-14T22:13:20.123Z\",\"url\":\"gated://" + folder + "/"
                                            + file + "\",\"sha256\":\"" + Sha256.hex(image) + "\",\"bytes\":"
                                            + image.length + ",\"contentType\":\"image/png\"}");
                });
        assertClean();
    }

    @Test
    void neverLetsABrokenImageBlockItsEvent() throws Exception {
        ReportedEvent broken = Pictures.event(
                "c1",
                T,
                Entity.builder("c1", "Camera").text("Image", "no picture!").number("Temperature", 3));

        harness.processElement(broken, T);
        await(() -> emitted().size() == 1);

        Entity entity = Entity.parse(emitted().get(0).record().value());
        assertThat(entity.json().at("/Image/value").isNull()).isTrue();
        assertThat(entity.number("Temperature")).hasValue(3.0);
        assertThat(emitted().get(0).record().headers()).containsEntry("image-broken", "not-an-image");
        assertThat(records(harness.getSideOutput(DeadLetters.TAG)))
                .singleElement()
                .satisfies(dead -> {
                    assertThat(dead.topic()).isEqualTo("data.raw.dead");
                    assertThat(dead.value()).isEqualTo(broken.record().value());
                    assertThat(dead.headers())
                            .containsEntry(DeadLetter.REASON, "not-an-image")
                            .containsEntry(DeadLetter.STAGE, "ingest-images")
                            .containsEntry(DeadLetter.SOURCE, "data.raw-0@7");
                });
        assertThat(files()).isEmpty();
        assertClean();
    }

    @Test
    void refusesAnImageThatIsLargerThanAllowed() throws Exception {
        byte[] large = java.util.Arrays.copyOf(Pictures.png(1), 200_000);

        harness.processElement(Pictures.camera("c1", T, large), T);
        await(() -> emitted().size() == 1);

        assertThat(emitted().get(0).record().headers()).containsEntry("image-broken", "too-large");
    }

    @Test
    void waitsAtTheEndForWhatIsUnderWay() throws Exception {
        harness.processElement(Pictures.camera("c1", T, Pictures.png(1)), T);

        harness.getOperator().finish();

        assertThat(emitted()).hasSize(1);
    }

    @Test
    void takesNoMoreThanItMayHold() throws Exception {
        use(harness(4_000, 4, 1, 0));
        for (int i = 0; i < 50; i++) { // each about 2 kB: the operator must let go before it takes another
            harness.processElement(Pictures.camera("c" + i, T, Pictures.png(i)), T);
            assertThat(((MoveImages) harness.getOperator()).bytesInFlight()).isLessThanOrEqualTo(4_000);
        }
        harness.endInput();
        harness.getOperator().finish();

        assertThat(emitted()).hasSize(50);
    }
}
