/** Shows the map and beside it the cards of the devices in view. */
import '/cards/cards.js';
import './map.js';
