package io.furrow.bench.ingest;

import java.util.List;

/** The jobs that run alternately. */
enum ComparedJob {
    /** Copies each record once, to the topic of the domain. */
    COPY_ONCE("copies to one topic", 1),
    /** Copies each record to the topics of the domain and of a mission. */
    COPY_TWICE("copies to two topics", 2),
    /** The job {@code ingest}, routes only. */
    ROUTES("ingest, routes only", 2),
    /** The job {@code ingest} with its defaults. */
    INGEST("ingest, with latest and catalog", 2);

    private final String title;
    private final int writes;

    ComparedJob(String title, int writes) {
        this.title = title;
        this.writes = writes;
    }

    String title() {
        return title;
    }

    /** Records on the topics of domain and missions per input record. */
    int writes() {
        return writes;
    }

    /** Additional options of the job. */
    List<String> options() {
        return this == ROUTES ? List.of("--no-latest", "--no-catalog") : List.of();
    }
}
