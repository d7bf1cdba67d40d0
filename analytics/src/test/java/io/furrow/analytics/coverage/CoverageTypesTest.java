package io.furrow.analytics.coverage;

import java.util.List;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

import io.furrow.analytics.Serializers;
import io.furrow.analytics.coverage.CoverageReport.Layer;
import io.furrow.analytics.coverage.WorkReport.Work;
import io.furrow.analytics.position.PositionFix;

import static org.assertj.core.api.Assertions.assertThat;

class CoverageTypesTest {
    private static final PositionFix FIX = Drives.fix("r", "weeding", 1, 2, 1000);
    private static final WorkReport REPORT = new WorkReport(FIX, 2, Work.ON);
    private static final Swath SWATH =
            new Swath(FIX, FIX, new FieldRef("f", 3, "North", "farm"), null, 1, 2, 3, 4, true);

    static Object[] records() {
        return new Object[] {
            REPORT,
            SWATH,
            new Drive(5, REPORT, 2, Work.OFF, 1, 2, 3, List.of(new Drive.Opened("key", 5))),
            Drive.NONE,
            new CoverageState(1, SWATH, 0.5, 2, 3, 4, List.of(SWATH), 9, List.of(new CoverageState.Sample(1, 2))),
            new CoverageReport(SWATH, 1, 2, 0.5, 3, 4, 5, 6, Double.NaN, null)
        };
    }

    @ParameterizedTest
    @MethodSource("records")
    void goThroughFlinksOwnSerializer(Object written) throws Exception {
        Serializers.assertPlain(written);
    }

    @Test
    void goThroughFlinksOwnSerializerWithTheirBytes() throws Exception {
        Swath swath = new Swath(FIX, FIX, SWATH.field(), new byte[] {1, 2}, 1, 2, 3, 4, true);
        Layer layer = new Layer(1, 2, 3, 4, 5, 6, new byte[] {7});

        assertThat(Serializers.copied(swath).area()).isEqualTo(swath.area());
        assertThat(Serializers.copied(layer).runs()).isEqualTo(layer.runs());
    }
}
