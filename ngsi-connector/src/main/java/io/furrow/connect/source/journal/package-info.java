/** The journals of a task: writes records into them and forwards records from them to Kafka. */
package io.furrow.connect.source.journal;
