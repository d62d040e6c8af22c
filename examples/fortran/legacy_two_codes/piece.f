C SPDX-License-Identifier: BSD-3-Clause
C
C Writes FOLDER/legacy_two_codes_<rank>.vtk, the piece of this rank in
C VTK's legacy text format: owned nodes and ghosts, triangles, and the
C temperature. Collective, because it updates the ghosts.
      SUBROUTINE PIECE(FOLDER)
      USE PNPBS
      INCLUDE 'mpif.h'
      INCLUDE 'nodes.inc'
      CHARACTER*(*) FOLDER
      CHARACTER*3 DIGITS
      INTEGER MYRANK, IERR, IU, K
      PARAMETER (IU = 20)
      INTEGER*8 NTRI, I, NODES3(3, 2 * MAXNOD)
      SAVE NODES3
      TYPE(PNPBS_PLACEMENT) PLC
      CALL GHOSTS
      CALL PLC%FROM_HANDLE(HPLC)
      CALL PLC%TRIANGLE_COUNT(NTRI)
      CALL PLC%GET_TRIANGLES(NODES3)
      CALL MPI_COMM_RANK(ICOMM, MYRANK, IERR)
      WRITE (DIGITS, '(I3.3)') MYRANK
      OPEN (IU, FILE=TRIM(FOLDER) // '/legacy_two_codes_' // DIGITS
     &      // '.vtk', STATUS='UNKNOWN')
      WRITE (IU, 100) NALL
      DO 10 I = 1, NALL
        WRITE (IU, 101) XY(1, I), XY(2, I)
   10 CONTINUE
      WRITE (IU, 102) NTRI, 4 * NTRI
      DO 20 I = 1, NTRI
        WRITE (IU, 103) (NODES3(K, I) - 1, K = 1, 3)
   20 CONTINUE
      WRITE (IU, 104) NTRI
      DO 30 I = 1, NTRI
        WRITE (IU, 105)
   30 CONTINUE
      WRITE (IU, 106) NALL
      DO 40 I = 1, NALL
        WRITE (IU, 107) TEMP(I)
   40 CONTINUE
      CLOSE (IU)
  100 FORMAT ('# vtk DataFile Version 3.0' / 'legacy_two_codes' /
     &        'ASCII' / 'DATASET UNSTRUCTURED_GRID' /
     &        'POINTS ', I9, ' double')
  101 FORMAT (2ES25.16E3, ' 0')
  102 FORMAT ('CELLS ', I9, 1X, I9)
  103 FORMAT ('3', 3I10)
  104 FORMAT ('CELL_TYPES ', I9)
  105 FORMAT ('5')
  106 FORMAT ('POINT_DATA ', I9 / 'SCALARS temperature double 1' /
     &        'LOOKUP_TABLE default')
  107 FORMAT (ES25.16E3)
      END
