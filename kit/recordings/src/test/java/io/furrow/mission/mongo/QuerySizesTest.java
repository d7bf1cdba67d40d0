package io.furrow.mission.mongo;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import static org.assertj.core.api.Assertions.assertThat;

/** Tests the maximum size of a query, in MiB. */
class QuerySizesTest {
    @ParameterizedTest
    @CsvSource({"256, 2", "1024, 4", "6144, 24", "65536, 64"})
    void growsWithTheHeap(long heap, long expected) {
        assertThat(OrderedDocumentReader.Sizes.queryBytes(heap << 20)).isEqualTo(expected << 20);
    }
}
