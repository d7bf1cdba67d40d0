package io.furrow.cli.compare;

import java.util.Collection;
import java.util.function.Consumer;

/** The topics of results. Only committed records are read, those of a partition in their order, up to the newest ones at the start. */
interface ResultTopics extends AutoCloseable {
    /** Names of all topics. */
    Collection<String> names();

    /** Reads a topic. @param from event time, epoch ms: earlier records may be left out */
    void read(String topic, long from, Consumer<ResultRecord> reader);

    /** Reads some of the newest records of a topic. */
    void readNewest(String topic, Consumer<ResultRecord> reader);

    @Override
    void close();
}
